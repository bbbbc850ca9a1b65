// Summed-area tables. Specified in probes/summed_area.h.

// The sum over a rectangle from the entries at its lower right corner and at the corners just outside of it
// [Pedersen2008, Eq. 6.2].
real boxSum(real lowerRight, real upperRight, real lowerLeft, real upperLeft) {
    return ((lowerRight - upperRight) - lowerLeft) + upperLeft;
}
