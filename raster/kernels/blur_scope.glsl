// What raster/kernels/blur.glsl reads, in GLSL: the weights in a buffer, the pixels of one row or column
// through a texture. The C++ counterpart is BlurKernel in raster/blur.h.

// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
layout(std430, set = 0, binding = 0) readonly buffer BlurWeights { real blurWeights[]; };
layout(set = 0, binding = 1) uniform sampler2DArray blurImage;
ivec3 blurPixel;
ivec2 blurStep;
ivec2 blurSize;
real blurWeight(int k) { return blurWeights[k]; }
real blurTap(int k) {
    ivec2 at = clamp(blurPixel.xy + k * blurStep, ivec2(0), blurSize - 1);
    return texelFetch(blurImage, ivec3(at, blurPixel.z), 0).x;
}
