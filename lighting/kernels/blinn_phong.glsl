// Specular reflection of a directional light: the Blinn-Phong lobe of the half vector, weighted with the cosine.
// needs: numeric/kernels/vector.glsl numeric/kernels/pair.glsl numeric/kernels/pair_pow.glsl
// n, v, l: unit normal, direction to the viewer, direction to the light. scale: (exponent + 8) / (8 pi), which keeps
// the reflected energy roughly independent of the exponent [Akenine2018, Eq. 9.56]. A lobe below 2^-60 is 0.
vec3 blinnPhong(vec3 n, vec3 v, vec3 l, vec3 irradiance, vec3 specular, real exponent, real scale) {
    real cosTheta = maxOf(dot3(n, l), real(0.0));
    real cosHalf = maxOf(dot3(n, unit3(add3(l, v))), real(0.0));
    real lobe = powOf(minOf(cosHalf, real(1.0)), exponent);
    real weight = select(lobe < real(8.673617379884035e-19), real(0.0), lobe) * (scale * cosTheta);
    return vec3(specular.x * (irradiance.x * weight), specular.y * (irradiance.y * weight),
                specular.z * (irradiance.z * weight));
}
