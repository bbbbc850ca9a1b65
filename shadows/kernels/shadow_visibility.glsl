// The part of a light that reaches a point by the light's shadow map. Specified in shadows/shadow_map.h.
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: raster/kernels/depth_unorm.glsl
// needs: shadows/kernels/shadow_scope.glsl
// needs: shadows/kernels/shadow_point.glsl
// needs: shadows/kernels/shadow_filter.glsl
// needs: shadows/kernels/shadow_disc.glsl

// position, normal and face as of shadowPoint; turn: the number of the pixel's turn of the pattern (disc, soft). 1
// where nothing is compared: behind the light, and where nothing is drawn.
real pointVisibility(ShadowSpace s, PointFilter f, vec3 position, vec3 normal, vec3 face, integer turn) {
    ShadowPoint p = shadowPoint(s, position, normal, face);
    boolean isCompared = p.isInFront && isLayerDrawn(p.layer);
    if (!isAny(isCompared)) return real(1.0);
    real lit = real(1.0);
    if (f.kind == 0) lit = litOfTexel(f, p);
    if (f.kind == 1) lit = litOfWindow(f, p);
    if (f.kind == 2) lit = litOfDisc(f, p, patternTurn(turn), f.radius);
    if (f.kind == 3) lit = litOfSoft(f, p, patternTurn(turn));
    return select(isCompared, lit, real(1.0));
}
