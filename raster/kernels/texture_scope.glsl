// Textures for kernel texts, in GLSL. The C++ counterpart is raster/texture_scope.inc; the two say the same.
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
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
// Four texels, by columns and rows.
struct RealTaps {
    real v00;
    real v10;
    real v01;
    real v11;
};
struct RgbTaps {
    vec3 v00;
    vec3 v10;
    vec3 v01;
    vec3 v11;
};
// Their weighted sum: sum 0 in the arithmetic, 1 by the unit.
real unitFiltered(RealTaps t, real fractionX, real fractionY, int sum, int texels) {
    TapWeights w = tapWeights(fractionX, fractionY);
    if (sum == 0) return weightedSum(t.v00, t.v10, t.v01, t.v11, w);
    WeightedTexels v;
    v.v00 = widened(t.v00);
    v.v10 = widened(t.v10);
    v.v01 = widened(t.v01);
    v.v11 = widened(t.v11);
    v.w00 = widened(w.w00) * wide(256.0);
    v.w10 = widened(w.w10) * wide(256.0);
    v.w01 = widened(w.w01) * wide(256.0);
    v.w11 = widened(w.w11) * wide(256.0);
    return real(unitSum(v, texels));
}
RealTaps realTapsOf(real v00, real v10, real v01, real v11) {
    RealTaps t;
    t.v00 = v00;
    t.v10 = v10;
    t.v01 = v01;
    t.v11 = v11;
    return t;
}
vec3 unitFilteredRgb(RgbTaps t, real fractionX, real fractionY, int sum, int texels) {
    return vec3(unitFiltered(realTapsOf(t.v00.x, t.v10.x, t.v01.x, t.v11.x), fractionX, fractionY, sum, texels),
                unitFiltered(realTapsOf(t.v00.y, t.v10.y, t.v01.y, t.v11.y), fractionX, fractionY, sum, texels),
                unitFiltered(realTapsOf(t.v00.z, t.v10.z, t.v01.z, t.v11.z), fractionX, fractionY, sum, texels));
}
real unitWritten(real value, int texels) { return real(writtenTexel(widened(value), texels)); }
vec3 unitWrittenRgb(vec3 v, int texels) {
    return vec3(unitWritten(v.x, texels), unitWritten(v.y, texels), unitWritten(v.z, texels));
}
RealTaps unitWrittenTaps(RealTaps t, int texels) {
    return realTapsOf(unitWritten(t.v00, texels), unitWritten(t.v10, texels), unitWritten(t.v01, texels),
                      unitWritten(t.v11, texels));
}
RgbTaps unitWrittenRgbTaps(RgbTaps t, int texels) {
    RgbTaps w;
    w.v00 = unitWrittenRgb(t.v00, texels);
    w.v10 = unitWrittenRgb(t.v10, texels);
    w.v01 = unitWrittenRgb(t.v01, texels);
    w.v11 = unitWrittenRgb(t.v11, texels);
    return w;
}
