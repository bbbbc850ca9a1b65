// Light from a point: its direction and what of it arrives.
// needs: numeric/kernels/vector.glsl
struct ArrivingLight {
    vec3 toLight;      // unit; 0 at the light itself
    real perIntensity;  // irradiance of a surface that faces the light, per radiant intensity: 1 / distance^2
};
// q: position of the light; p: position of the surface.
ArrivingLight pointLight(vec3 q, vec3 p) {
    vec3 d = sub3(q, p);
    real square = dot3(d, d);
    boolean apart = square > real(0.0);
    ArrivingLight a;
    a.toLight = unit3(d);
    a.perIntensity = select(apart, real(1.0) / select(apart, square, real(1.0)), real(0.0));
    return a;
}
// The part of a spot light's intensity that goes towards -toLight: 1 inside the inner cone, 0 outside the outer one,
// between them 3 t^2 - 2 t^3 with t linear in the cosine. axis: unit, the way the light travels; cosInner > cosOuter.
real spotPart(vec3 toLight, vec3 axis, real cosInner, real cosOuter) {
    real cosine = -dot3(toLight, axis);
    real t = clampOf((cosine - cosOuter) / (cosInner - cosOuter), real(0.0), real(1.0));
    return (t * t) * (real(3.0) - (t + t));
}
