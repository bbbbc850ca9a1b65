// Mirror reflection [Karlsson2005, sec. on reflective maps; r = 2 (n.v) n - v].
// needs: numeric/kernels/vector.glsl
// n: unit normal; v: direction to the viewer, of any length. Returns a direction of the length of v.
vec3 mirrorDirection(vec3 n, vec3 v) {
    real twice = real(2.0) * dot3(n, v);
    return vec3(twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z);
}
