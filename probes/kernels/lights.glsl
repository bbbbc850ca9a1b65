// The irradiance of directional lights.
// needs: numeric/kernels/vector.glsl

// The irradiance of a surface, `sum`, with that of one more light, which gives `energy` to a surface that faces
// it [Pedersen2008, Eq. 5.13]. Both vectors have length 1.
vec3 addLight(vec3 sum, vec3 normal, vec3 direction, vec3 energy) {
    real cosine = maxOf(real(0.0), dot3(normal, direction));
    return add3(sum, scale3(energy, cosine));
}
