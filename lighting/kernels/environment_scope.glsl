// What lighting/kernels/environment_light.glsl reads, in GLSL. The C++ counterpart is EnvironmentLighting in
// lighting/environment_lighting.h.
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl

// Texels are the sources of probes/kernels/irradiance_scope.glsl.
layout(set = 3, binding = 1) uniform sampler2DArray irradianceMap;
layout(std140, set = 3, binding = 2) uniform EnvironmentSettings {
    int environmentLightKind;
    int environmentLightDegree;
    int environmentTexelRuns;
    int environmentTexelRunLength;
    vec2 environmentTexelUnscales;
    Sampling irradianceMapSampling;
};
int environmentKind() { return environmentLightKind; }
int environmentDegree() { return environmentLightDegree; }
int texelRunCount() { return environmentTexelRuns; }
int texelRunLength() { return environmentTexelRunLength; }
real texelUnscale(int part) { return environmentTexelUnscales[part]; }
vec3 mapAlong(vec3 direction) { return sampleCubeRgb(irradianceMap, direction, irradianceMapSampling); }
