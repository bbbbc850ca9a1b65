#version 450
// The six faces of a cube map, one below the other, from a lat-long image; conventions of docs/conventions.md.
layout(set = 0, binding = 1) uniform sampler2D latLong;
layout(constant_id = 0) const int kSize = 256;
layout(location = 0) out vec4 radiance;
const float kPi = 3.14159265358979;
void main() {
    int face = int(gl_FragCoord.y) / kSize;
    float s = 2.0 * gl_FragCoord.x / kSize - 1.0, t = 2.0 * (gl_FragCoord.y / kSize - face) - 1.0;
    vec3 d = face == 0 ? vec3(1, -t, -s) : face == 1 ? vec3(-1, -t, s) : face == 2 ? vec3(s, 1, t)
           : face == 3 ? vec3(s, -1, -t) : face == 4 ? vec3(s, -t, 1) : vec3(-s, -t, -1);
    vec2 uv = vec2(0.5 - atan(d.x, d.z) / (2.0 * kPi), 0.5 - atan(d.y, length(d.xz)) / kPi);
    radiance = textureLod(latLong, uv, 0.0);
}
