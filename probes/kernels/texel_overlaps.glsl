// A texel of a converted probe as the mean of the source's texels over its solid angle. Specified in probes/convert.h.
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_atan2.glsl
// needs: numeric/kernels/pair_sine.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: probes/kernels/latlong.glsl
// needs: probes/kernels/mapping.glsl
// needs: probes/kernels/probe_sampler.glsl
// needs: probes/kernels/texel_overlaps_scope.glsl

// Of the first `count` overlaps in order, in runs of 32: the mean of each run, and the mean of the runs, each of which
// weighs as much as its texels. isMasked: 0 if every texel of the source is shown.
ProbeMean meanOfOverlaps(texture radiance, texture shown, int isMasked, int count) {
    int run = 32;
    ProbeMean mean = noSamples();
    for (int first = 0; first < count; first += run) {
        ProbeMean ofRun = noSamples();
        for (int k = first; k < first + run && k < count; k++) {
            CubeTexel t = overlapTexel(k);
            ProbeSample value = probeSample(fetchRgb(radiance, t.face, t.x, t.y), boolean(true));
            if (isMasked != 0) value.isShown = isShownTexel(shown, t);
            ofRun = addSample(ofRun, value, overlapWeight(k));
        }
        mean = addSample(mean, probeSample(ofRun.rgb, boolean(true)), ofRun.weight);
    }
    return mean;
}
