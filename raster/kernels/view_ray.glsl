// The direction through a pixel position, of any length: forward + ((x - cx) perX + (y - cy) perY).
vec3 viewRay(real x, real y, real cx, real cy, vec3 forward, vec3 perX, vec3 perY) {
    real dx = x - cx;
    real dy = y - cy;
    return vec3(forward.x + (dx * perX.x + dy * perY.x), forward.y + (dx * perX.y + dy * perY.y),
                forward.z + (dx * perX.z + dy * perY.z));
}
