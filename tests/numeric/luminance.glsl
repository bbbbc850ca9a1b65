// Relative luminance of linear Rec.709 radiance: the worked example of docs/kernels.md.
// needs: numeric/kernels/vector.glsl
real luminance(vec3 radiance) {
    return dot3(radiance, vec3(real(0.2126), real(0.7152), real(0.0722)));
}
