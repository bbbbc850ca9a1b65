// Textures for kernel texts, in GLSL. The C++ counterpart is raster/texture_scope.inc; the two say the same.
#define texture sampler2DArray
real fetchReal(texture t, integer layer, integer x, integer y) {
    return texelFetch(t, ivec3(x, y, layer), 0).x;
}
vec3 fetchRgb(texture t, integer layer, integer x, integer y) {
    return texelFetch(t, ivec3(x, y, layer), 0).xyz;
}
