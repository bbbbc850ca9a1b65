#version 450
// World space to clip space, with what the fragment shader reads.
layout(push_constant) uniform Push {
    mat4 worldToClip;
    vec4 eye;
};
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 worldNormal;
void main() {
    gl_Position = worldToClip * vec4(position, 1.0);
    world = position;
    worldNormal = normal;
}
