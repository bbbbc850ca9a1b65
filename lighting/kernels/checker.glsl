// Checkerboard: true on the squares of odd parity. u, v: surface position; perSquare: reciprocal of a square's side.
boolean isOddSquare(real u, real v, real perSquare) {
    real i = floor(u * perSquare);
    real j = floor(v * perSquare);
    real sum = i + j;
    return floor(sum * real(0.5)) * real(2.0) < sum;
}
