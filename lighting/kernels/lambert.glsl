// Diffuse reflection of a directional light.
// needs: numeric/kernels/vector.glsl
// n: unit normal; l: unit direction to the light; irradiance: on a surface that faces the light; albedo: in [0, 1].
vec3 lambert(vec3 n, vec3 l, vec3 irradiance, vec3 albedo) {
    real cosTheta = maxOf(dot3(n, l), real(0.0));
    real w = cosTheta * real(0.3183098861837907);  // 1 / pi
    return vec3(albedo.x * (irradiance.x * w), albedo.y * (irradiance.y * w), albedo.z * (irradiance.z * w));
}
// The same of an irradiance that has gone through its cosines.
vec3 lambertOfIrradiance(vec3 irradiance, vec3 albedo) {
    real w = real(0.3183098861837907);  // 1 / pi
    return vec3(albedo.x * (irradiance.x * w), albedo.y * (irradiance.y * w), albedo.z * (irradiance.z * w));
}
