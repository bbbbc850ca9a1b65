#version 450
// Positions alone: there is no fragment shader behind it.
layout(push_constant) uniform Push {
    mat4 worldToClip;
    vec4 eye;
};
layout(location = 0) in vec3 position;
void main() { gl_Position = worldToClip * vec4(position, 1.0); }
