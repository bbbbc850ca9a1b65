// A point of a surface, as light finds it.
// needs: numeric/kernels/vector.glsl
struct SurfacePoint {
    vec3 position;
    vec3 normal;  // unit, on the side that is seen
    vec3 toEye;   // unit
};
// A normal of any length as a unit vector on the side that is seen; facing: 1 on the front, -1 on the back.
vec3 seenNormal(vec3 normal, real facing) { return scale3(unit3(normal), facing); }
// The unit normal of a triangle, on the side from which its corners run counter-clockwise; 0 if it has no area.
vec3 faceNormal(vec3 a, vec3 b, vec3 c) { return unit3(cross3(sub3(b, a), sub3(c, a))); }
// The unit vector from p to the eye, and the distance.
vec3 directionToEye(vec3 eye, vec3 p) { return unit3(sub3(eye, p)); }
real distanceToEye(vec3 eye, vec3 p) { return length3(sub3(eye, p)); }
