// What the texts of shadow maps read, in GLSL: the depths through a texture, pattern and turns in buffers. The C++
// counterpart is shadows/shadow_scope.inc; the two say the same.
// needs: raster/kernels/depth_unorm.glsl

// Texels are numbers of the map's depth, or where references are quantised its stored integers.
layout(set = 0, binding = 0) uniform sampler2DArray shadowMap;
layout(std430, set = 0, binding = 1) readonly buffer ShadowPattern { vec2 shadowPattern[]; };
layout(std430, set = 0, binding = 2) readonly buffer ShadowTurns { vec2 shadowTurns[]; };
layout(std430, set = 0, binding = 3) readonly buffer ShadowLayers {
    real shadowOutside;  // the texels around a layer: the farthest
    real shadowLevels;   // quantised: the largest stored integer
    int shadowDrawn[6];
};

boolean isLayerDrawn(integer layer) { return shadowDrawn[layer] == 1; }
real shadowTexel(integer layer, integer x, integer y) {
    ivec2 size = textureSize(shadowMap, 0).xy;
    bool isInside = x >= 0 && y >= 0 && x < size.x && y < size.y;
    return isInside ? texelFetch(shadowMap, ivec3(x, y, layer), 0).x : shadowOutside;
}
boolean isBelowStored(real texel, real depth) { return texel < unormDepth(depth, shadowLevels); }
vec2 patternPoint(int k) { return shadowPattern[k]; }
vec2 patternTurn(integer i) { return shadowTurns[i]; }
