// What probes/kernels/latlong_moments.glsl reads and writes beside texels and harmonics, in GLSL: functions of longitude,
// function after function, and the moments of the invocation's row. The C++ counterpart is LatLongMomentsKernel in
// probes/latlong_moments.cpp.

layout(std430, set = 1, binding = 15) buffer LongitudeValues { real longitudeValues[]; };
layout(std430, set = 1, binding = 16) readonly buffer AzimuthalMoments { real azimuthalMoments[]; };
int longitudeColumns;
int longitudeColumn;
int firstMoment;
real longitudeValue(int function, int x) { return longitudeValues[function * longitudeColumns + x]; }
void setLongitudeValue(int function, real value) {
    longitudeValues[function * longitudeColumns + longitudeColumn] = value;
}
vec3 azimuthalMoment(int function) {
    int i = 3 * (firstMoment + function);
    return vec3(azimuthalMoments[i], azimuthalMoments[i + 1], azimuthalMoments[i + 2]);
}
