// Affine and projective transforms with a written order of operations.
// One row of a 4x4 matrix times the point (p, 1).
real transformRow(vec4 row, vec3 p) { return row.x * p.x + (row.y * p.y + (row.z * p.z + row.w)); }
vec4 transformPoint(vec4 row0, vec4 row1, vec4 row2, vec4 row3, vec3 p) {
    return vec4(transformRow(row0, p), transformRow(row1, p), transformRow(row2, p), transformRow(row3, p));
}
