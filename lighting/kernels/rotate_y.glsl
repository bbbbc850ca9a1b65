// Rotation about +Y by the angle with this cosine and sine; counter-clockwise as seen from +Y (Z turns to X).
vec3 rotateY(vec3 d, real cosAngle, real sinAngle) {
    return vec3(cosAngle * d.x + sinAngle * d.z, d.y, cosAngle * d.z - sinAngle * d.x);
}
