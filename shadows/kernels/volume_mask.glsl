// The part of a pixel's samples that is lit, from the mask of shadow volumes. Specified in shadows/volume_shadows.h.
// needs: shadows/kernels/volume_scope.glsl

// Of the samples that show the point's instance; where none does, of all.
real litPartOfSamples(int samples) {
    integer own = integer(0);
    integer ownLit = integer(0);
    integer allLit = integer(0);
    for (int s = 0; s < samples; s++) {
        integer one = selectInteger(isOwnSample(s), integer(1), integer(0));
        integer lit = selectInteger(isLitSample(s), integer(1), integer(0));
        own = own + one;
        ownLit = ownLit + one * lit;
        allLit = allLit + lit;
    }
    boolean isShown = lessInteger(integer(0), own);
    return toReal(selectInteger(isShown, ownLit, allLit)) / toReal(selectInteger(isShown, own, integer(samples)));
}
