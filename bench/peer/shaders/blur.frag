#version 450
// One direction of a separable blur; beyond the image the border pixel repeats.
layout(constant_id = 0) const int kAlongY = 0;
layout(constant_id = 1) const int kRadius = 10;
layout(set = 0, binding = 0) uniform Weights { vec4 weights[32]; };  // x of each
layout(set = 0, binding = 1) uniform sampler2D image;
layout(location = 0) out float blurred;
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy), last = textureSize(image, 0) - 1;
    // Not a choice between two vectors: lavapipe 22.3 takes the first whatever the specialised constant is.
    ivec2 along = ivec2(1 - kAlongY, kAlongY);
    float sum = 0.0;
    for (int k = -kRadius; k <= kRadius; k++)
        sum += weights[abs(k)].x * texelFetch(image, clamp(p + k * along, ivec2(0), last), 0).x;
    blurred = sum;
}
