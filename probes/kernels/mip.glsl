// A texel of the next coarser level of a mip pyramid. Specified in probes/mip_pyramid.h.
// needs: numeric/kernels/vector.glsl
// needs: probes/kernels/mip_scope.glsl

// Its radiance, black where it is not valid.
struct MipTexel {
    vec3 rgb;
    boolean isValid;
};
// The mean of its parts in columns and rows of the finer level, row by row, weighted with their solid angles. It is
// valid if at least half of its solid angle is.
MipTexel meanOfParts(int columns, int rows) {
    real all_sr = real(0.0);
    real valid_sr = real(0.0);
    vec3 sum = vec3(real(0.0), real(0.0), real(0.0));
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            real weight_sr = partWeight_sr(column, row);
            boolean isValid = partIsValid(column, row);
            all_sr = all_sr + weight_sr;
            valid_sr = select(isValid, valid_sr + weight_sr, valid_sr);
            vec3 next = add3(sum, scale3(partRadiance(column, row), weight_sr));
            sum = vec3(select(isValid, next.x, sum.x), select(isValid, next.y, sum.y), select(isValid, next.z, sum.z));
        }
    MipTexel texel;
    texel.isValid = valid_sr >= real(0.5) * all_sr;
    real divisor_sr = select(texel.isValid, valid_sr, real(1.0));
    texel.rgb = vec3(select(texel.isValid, sum.x / divisor_sr, real(0.0)),
                     select(texel.isValid, sum.y / divisor_sr, real(0.0)),
                     select(texel.isValid, sum.z / divisor_sr, real(0.0)));
    return texel;
}
