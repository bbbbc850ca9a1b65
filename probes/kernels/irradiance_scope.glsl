// What probes/kernels/irradiance_sums.glsl reads and writes, in GLSL: sources in a buffer, six numbers each; one plane per
// invocation. The C++ counterpart is probes/irradiance_scope.inc.

layout(std430, set = 1, binding = 5) readonly buffer Sources { real sources[]; };
vec3 normalOfPlane;
vec3 pendingSums[32];
vec3 sourceDirection(int i) { return vec3(sources[6 * i], sources[6 * i + 1], sources[6 * i + 2]); }
vec3 sourceFlux(int i) { return vec3(sources[6 * i + 3], sources[6 * i + 4], sources[6 * i + 5]); }
vec3 planeNormal(int plane) { return normalOfPlane; }
void setPlaneNormal(vec3 normal) { normalOfPlane = normal; }
vec3 pendingSum(int plane, int i) { return pendingSums[i]; }
void setPendingSum(int plane, int i, vec3 sum) { pendingSums[i] = sum; }
