// Depth and attributes from the exact edge values (rule 5).

real min3(vec3 a) { return minOf(minOf(a.x, a.y), a.z); }
real max3(vec3 a) { return maxOf(maxOf(a.x, a.y), a.z); }

// Depth, linear in screen space, inside the hull of the vertex depths. e: edge values, each rounded once;
// r: reciprocal of the area; lowest, highest: min3(z) and max3(z).
real interpolateDepth(vec3 e, real r, vec3 z, real lowest, real highest) {
    real l_0 = e.x * r;
    real l_1 = e.y * r;
    real l_2 = e.z * r;
    real sum = l_0 * z.x + (l_1 * z.y + l_2 * z.z);
    return clampOf(sum, lowest, highest);
}

// Perspective-correct barycentric weights. e: edge values scaled so that the area is in [1, 2); q: reciprocals of
// w scaled so that the largest is in [1, 2).
vec3 perspectiveWeights(vec3 e, vec3 q) {
    real c_0 = e.x * q.x;
    real c_1 = e.y * q.y;
    real c_2 = e.z * q.z;
    real sum = c_0 + (c_1 + c_2);
    boolean usable = sum > real(0.0);
    real divisor = select(usable, sum, real(1.0));
    real b_0 = select(usable, c_0 / divisor, real(1.0));
    real b_1 = select(usable, c_1 / divisor, real(0.0));
    real b_2 = select(usable, c_2 / divisor, real(0.0));
    real floor_b = real(8.673617379884035e-19);  // 2^-60
    return vec3(select(b_0 < floor_b, real(0.0), b_0), select(b_1 < floor_b, real(0.0), b_1),
                select(b_2 < floor_b, real(0.0), b_2));
}

// One attribute from its weights, inside the hull of the vertex values.
real interpolateAttribute(vec3 b, vec3 a) {
    real sum = b.x * a.x + (b.y * a.y + b.z * a.z);
    return clampOf(sum, min3(a), max3(a));
}
