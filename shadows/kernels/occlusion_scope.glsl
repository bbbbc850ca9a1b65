// What shadows/kernels/occlusion.glsl reads of drawn views, in GLSL: a layer of two textures for each view, its record in
// a buffer. The C++ counterpart is OcclusionKernels in shadows/occlusion_kernels.h; the two say the same.

// A parallel view of everything from the direction `towards`, size x size texels. rows: world space to x and y in
// [-1, 1] and the depth. offset: metres that a point is looked up above its surface.
struct ParallelView {
    vec3 towards;
    vec4 rowX;
    vec4 rowY;
    vec4 rowZ;
    int size;
    real offset;
};
// A face of a hemicube around one point: the directions of its texels, and whether what is farther than 2^10 times its
// near plane does not cover (1 or 0).
struct HemicubeFace {
    vec3 forward;
    vec3 perX;
    vec3 perY;
    real centreX;
    real centreY;
    int width;
    int height;
    int isLimited;
};
layout(set = 0, binding = 0) uniform sampler2DArray occlusionDepth;
layout(set = 0, binding = 1) uniform usampler2DArray occlusionTriangle;
layout(std430, set = 0, binding = 2) readonly buffer ParallelViews { ParallelView parallelViews[]; };
layout(std430, set = 0, binding = 3) readonly buffer HemicubeFaces { HemicubeFace hemicubeFaces[]; };
// Of the faces' texels, face after face and row after row.
layout(std430, set = 0, binding = 4) readonly buffer OcclusionWeights { real occlusionWeights[]; };
layout(std430, set = 0, binding = 5) readonly buffer OcclusionWeightsOfFaces { int firstWeights[]; };

ParallelView parallelView(int view) { return parallelViews[view]; }
HemicubeFace hemicubeFace(int view) { return hemicubeFaces[view]; }
boolean isDrawn(int view, integer column, integer row) {
    return texelFetch(occlusionTriangle, ivec3(column, row, view), 0).x != 0xffffffffu;
}
real drawnDepth(int view, integer column, integer row) {
    return texelFetch(occlusionDepth, ivec3(column, row, view), 0).x;
}
real texelWeight(int view, int i) { return occlusionWeights[firstWeights[view] + i]; }
