// Buffers of lights for kernel texts, in GLSL. The C++ counterpart is lighting/light_scope.inc; the two say the same.

// What a light is to the points that it lights.
struct Light {
    vec3 place;     // directional: the unit vector towards it; else its position
    int kind;       // 0 directional, 1 point, 2 spot
    vec3 power;     // of a surface that faces a directional light, its irradiance; else intensity, of a spot on its axis
    int shadowRow;  // where its visibility is found; -1: nothing stands in its way
    int isFinite;   // 1: the power is finite
};
// Of a spot light (lighting/kernels/positional_light.glsl).
struct LightCone {
    vec3 axis;
    real cosInner;
    real cosOuter;
};
struct LightRecord {
    Light light;
    LightCone cone;
};
// Some lights, one after the other.
struct LightBuffer {
    int first;
    int count;
};
// Of one invocation, the part of each light that reaches it, 0 to 1: one number per row.
struct VisibilityBuffer {
    int first;
    int stride;
};
layout(std430, set = 2, binding = 0) readonly buffer Lights { LightRecord lightRecords[]; };
layout(std430, set = 2, binding = 1) readonly buffer Visibilities { real visibilities[]; };

int lightCount(LightBuffer lights) { return lights.count; }
Light lightAt(LightBuffer lights, int l) { return lightRecords[lights.first + l].light; }
LightCone coneAt(LightBuffer lights, int l) { return lightRecords[lights.first + l].cone; }
real visibilityOf(VisibilityBuffer shadows, int row) { return visibilities[shadows.first + row * shadows.stride]; }
