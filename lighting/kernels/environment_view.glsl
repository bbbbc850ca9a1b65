// The environment as it is seen: behind the scene and in mirrors.
// needs: numeric/kernels/vector.glsl
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_atan2.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: raster/kernels/view_ray.glsl
// needs: probes/kernels/latlong.glsl
// needs: lighting/kernels/mirror.glsl
// needs: lighting/kernels/rotate_y.glsl

// Radiance from far away: the same from everywhere, or an image of it. Its directions are those of the world turned
// about +Y.
struct EnvironmentView {
    int isConstant;  // 1: the constant
    vec3 constant;
    real cosTurn;
    real sinTurn;
};
// The direction through a pixel position is that of viewRay().
struct PixelRays {
    real centreX;
    real centreY;
    vec3 forward;
    vec3 perX;
    vec3 perY;
};
// Behind pixel position x, y. latLong: the image; not read where the radiance is constant.
vec3 backgroundRadiance(EnvironmentView e, texture latLong, Sampling s, PixelRays rays, real x, real y) {
    if (e.isConstant != 0) return e.constant;
    vec3 ray = viewRay(x, y, rays.centreX, rays.centreY, rays.forward, rays.perX, rays.perY);
    return sampleLatLong(latLong, rotateY(ray, e.cosTurn, e.sinTurn), s);
}
// Towards a point with the unit normal n along the mirrored direction to the eye. shows: 0 the environment's constant,
// 1 its cube map, 2 a cube map of the scene, whose directions are those of the world.
vec3 mirroredRadiance(EnvironmentView e, int shows, texture cube, Sampling s, vec3 n, vec3 toEye) {
    if (shows == 0) return e.constant;
    vec3 direction = mirrorDirection(n, toEye);
    if (shows == 1) direction = rotateY(direction, e.cosTurn, e.sinTurn);
    return sampleCubeRgb(cube, direction, s);
}
