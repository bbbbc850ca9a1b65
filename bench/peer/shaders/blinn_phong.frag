#version 450
// Lambert and Blinn-Phong with directional lights, as lighting/kernels has them, in the device's own functions.
// Alpha is the distance from the eye.
layout(constant_id = 0) const int kLights = 1;
layout(push_constant) uniform Push {
    mat4 worldToClip;
    vec4 eye;
};
layout(set = 0, binding = 0) uniform Shading {
    vec4 diffuse;   // divided by pi; w: exponent
    vec4 specular;  // times (exponent + 8) / (8 pi)
    vec4 ambient;   // times the diffuse reflectance
    vec4 toLight[64];
    vec4 irradiance[64];
};
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 worldNormal;
layout(location = 0) out vec4 radiance;
void main() {
    vec3 n = normalize(worldNormal);
    if (!gl_FrontFacing) n = -n;
    vec3 toEye = eye.xyz - world;
    float distance_m = length(toEye);
    vec3 v = toEye / distance_m;
    vec3 sum = ambient.xyz;
    for (int i = 0; i < kLights; i++) {
        vec3 l = toLight[i].xyz;
        float cosTheta = max(dot(n, l), 0.0);
        float lobe = pow(max(dot(n, normalize(l + v)), 0.0), diffuse.w);
        sum += (diffuse.xyz + specular.xyz * lobe) * (irradiance[i].xyz * cosTheta);
    }
    radiance = vec4(sum, distance_m);
}
