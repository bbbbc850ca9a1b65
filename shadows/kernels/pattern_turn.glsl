// Which turn of the disc's pattern a pixel takes: the number that the last steps of splitmix64 [Steele2014] make of a
// key and the pixel, modulo the number of turns. In halves of 32 bits, for GPUs without integers of 64.

struct Halves {
    uint high;
    uint low;
};

// The lower 64 bits of the product.
Halves productOf(Halves a, Halves b) {
    Halves p;
    p.low = a.low * b.low;
    p.high = upperProduct(a.low, b.low) + (a.low * b.high + a.high * b.low);
    return p;
}
// a ^ (a >> bits); 0 < bits < 32.
Halves foldedBy(Halves a, int bits) {
    Halves h;
    h.low = a.low ^ ((a.low >> bits) | (a.high << (32 - bits)));
    h.high = a.high ^ (a.high >> bits);
    return h;
}
// turns: a power of two, up to 2^16. key: of the pattern.
int turnOfPixel(Halves key, uint x_px, uint y_px, int turns) {
    Halves h;
    h.high = key.high ^ y_px;
    h.low = key.low ^ x_px;
    Halves factor;
    factor.high = 0xbf58476du;
    factor.low = 0x1ce4e5b9u;
    h = productOf(foldedBy(h, 30), factor);
    factor.high = 0x94d049bbu;
    factor.low = 0x133111ebu;
    h = productOf(foldedBy(h, 27), factor);
    return int((h.high >> 1) & uint(turns - 1));
}
