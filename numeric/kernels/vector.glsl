// Three-component vectors with a written order of operations (never the library's dot, whose order may change).
real dot3(vec3 a, vec3 b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
vec3 add3(vec3 a, vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
vec3 sub3(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
vec3 mul3(vec3 a, vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
vec3 scale3(vec3 a, real s) { return vec3(a.x * s, a.y * s, a.z * s); }
vec3 cross3(vec3 a, vec3 b) { return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }
real length3(vec3 a) { return sqrt(dot3(a, a)); }
// The vector of length one; (0, 0, 0) for the zero vector.
vec3 unit3(vec3 a) {
    real square = dot3(a, a);
    real s = select(square > real(0.0), real(1.0) / sqrt(square), real(0.0));
    return scale3(a, s);
}
