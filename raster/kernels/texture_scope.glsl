// Textures for kernel texts, in GLSL. The C++ counterpart is raster/texture_scope.inc; the two say the same.
#define texture sampler2DArray
real fetchReal(texture t, integer layer, integer x, integer y) {
    return texelFetch(t, ivec3(x, y, layer), 0).x;
}
vec3 fetchRgb(texture t, integer layer, integer x, integer y) {
    return texelFetch(t, ivec3(x, y, layer), 0).xyz;
}
// Two texels, mostly neighbours in a row.
struct RgbPair {
    vec3 first;
    vec3 second;
};
RgbPair fetchRgbPair(texture t, integer layer0, integer x0, integer y0, integer layer1, integer x1, integer y1) {
    RgbPair pair;
    pair.first = fetchRgb(t, layer0, x0, y0);
    pair.second = fetchRgb(t, layer1, x1, y1);
    return pair;
}
