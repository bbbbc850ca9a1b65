// What a material reflects.
// needs: numeric/kernels/vector.glsl
// needs: lighting/kernels/checker.glsl
struct Reflectances {
    vec3 diffuse;
    vec3 diffuse2;  // on the squares of odd parity of a checkerboard
    real perSquare;  // the reciprocal of the side of a square
    int hasChecker;  // 1: there is a checkerboard
    vec3 specular;
    real exponent;   // of the specular lobe (lighting/kernels/blinn_phong.glsl),
    real lobeScale;  // and (exponent + 8) / (8 pi)
    vec3 mirror;
};
// The diffuse reflectance at surface coordinates u, v.
vec3 albedoAt(Reflectances r, real u, real v) {
    if (r.hasChecker == 0) return r.diffuse;
    boolean isOdd = isOddSquare(u, v, r.perSquare);
    return vec3(select(isOdd, r.diffuse2.x, r.diffuse.x), select(isOdd, r.diffuse2.y, r.diffuse.y),
                select(isOdd, r.diffuse2.z, r.diffuse.z));
}
