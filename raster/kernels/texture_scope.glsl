// Textures for kernel texts, in GLSL. The C++ counterpart is raster/texture_scope.inc; the two say the same.
// needs: raster/kernels/texture_unit.glsl
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
// The texture unit of rule 22 (raster/texture_unit.h). size and wrap as in unitLinear; texels: the format, as in unitSum.
struct UnitTexel {
    integer first;
    real fraction;
};
UnitTexel unitTexel(real u, int size, int wrap) {
    WideTexel found = unitLinear(widened(u), size, wrap);
    UnitTexel texel;
    texel.first = int(found.first);
    texel.fraction = real(found.fraction);
    return texel;
}
integer unitNearestTexel(real u, int size, int wrap) { return int(unitNearest(widened(u), size, wrap)); }
// Weights are multiples of 1/256.
real unitTexelSum(real v00, real v10, real v01, real v11, real w00, real w10, real w01, real w11, int texels) {
    WeightedTexels t;
    t.v00 = widened(v00);
    t.v10 = widened(v10);
    t.v01 = widened(v01);
    t.v11 = widened(v11);
    t.w00 = widened(w00) * wide(256.0);
    t.w10 = widened(w10) * wide(256.0);
    t.w01 = widened(w01) * wide(256.0);
    t.w11 = widened(w11) * wide(256.0);
    return real(unitSum(t, texels));
}
real unitWritten(real value, int texels) { return real(writtenTexel(widened(value), texels)); }
