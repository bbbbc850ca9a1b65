// Mappings of directions onto the images of a probe, and back. Specified in probes/mapping.h.
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

// mapping: 0 lat-long, 1 cube, 2 angular, 3 mirror ball, 4 octahedral, 5 lat-long of [Pedersen2008, Listing 6.1].
// Of the mirror ball: k is 1 / its distance in radii, 0 for the orthographic view; root is sqrt(1 - k^2).
struct MappingSettings {
    int mapping;
    int newtonSteps;
    real k;
    real root;
};

// u to the right and v downwards on the image of a layer, both in [0, 1].
struct MappingPoint {
    integer layer;
    real u;
    real v;
    boolean isShown;
};

// From [-1, 1], x to the right and y upwards, to [0, 1].
real imageU(real x) { return clampOf(real(0.5) + real(0.5) * x, real(0.0), real(1.0)); }
real imageV(real y) { return clampOf(real(0.5) - real(0.5) * y, real(0.0), real(1.0)); }

// The vector of length `radius` along (x, y), whose length is `ring`; (radius, 0) for the zero vector.
vec2 discPoint(real x, real y, real ring, real radius) {
    boolean isMiddle = !(ring > real(0.0));
    real scale = radius / select(isMiddle, real(1.0), ring);
    return vec2(select(isMiddle, radius, x * scale), select(isMiddle, real(0.0), y * scale));
}

// The point of the unit disc that shows direction d: the polar angle from +Z in units of pi is the radius.
vec2 angularPoint(vec3 d) {
    real ring = sqrt(d.x * d.x + d.y * d.y);
    return discPoint(d.x, d.y, ring, atan2Of(ring, d.z) * real(0.3183098861837907));
}
// And back; points beyond the disc count as the nearest one of its rim.
vec3 angularDirection(real x, real y) {
    real radius = sqrt(x * x + y * y);
    real polar_rad = real(3.141592653589793) * minOf(radius, real(1.0));
    real s = select(radius > real(0.0), sinOf(polar_rad) / select(radius > real(0.0), radius, real(1.0)), real(0.0));
    return vec3(x * s, y * s, cosOf(polar_rad));
}

// The point of the unit disc where a mirror ball shows the unit direction d.
// In the plane of d and the axis towards the eye let the polar angles be 2 h of d and b of the ball's normal. The ray
// to the eye leaves at b - (2 h - b), and with delta = h - b that is sin(2 delta) = k sin(h + delta). In t =
// tan(delta) it reads 2 t = k sqrt(1 + t^2) (sin h + t cos h): Newton's method, started at its first step from 0.
vec2 ballPoint(vec3 d, MappingSettings m) {
    real ring = sqrt(d.x * d.x + d.y * d.y);
    // The half angle, each part from the sum that does not cancel.
    boolean isFront = d.z >= real(0.0);
    real major = sqrt(real(0.5) * (real(1.0) + absOf(d.z)));
    real minor = real(0.5) * ring / major;
    real sinH = select(isFront, minor, major);
    real cosH = select(isFront, major, minor);
    if (m.newtonSteps == 0) return discPoint(d.x, d.y, ring, minOf(sinH, real(1.0)));
    real t = m.k * sinH / (real(2.0) - m.k * cosH);
    for (int i = 0; i < m.newtonSteps; i++) {
        real w = sqrt(real(1.0) + t * t);
        real g = sinH + t * cosH;
        real slope = real(2.0) - m.k * (t * g / w + w * cosH);
        t = t - (real(2.0) * t - m.k * w * g) / slope;
    }
    real w = sqrt(real(1.0) + t * t);
    real sinB = (sinH - t * cosH) / w;
    real cosB = (cosH + t * sinH) / w;
    return discPoint(d.x, d.y, ring, clampOf(sinB * m.root / (real(1.0) - m.k * cosB), real(0.0), real(1.0)));
}
// False for directions behind the ball, within asin(k) of -Z.
boolean isOnBall(vec3 d, MappingSettings m) { return d.z >= -m.root; }
// The direction, of length one, that the ball shows at a point of the disc; points beyond it count as the nearest one
// of its rim. With the point's distance p from the middle the ray hits where q = sqrt(1 - p^2) is the cosine of its
// angle to the normal.
vec3 ballDirection(real x, real y, MappingSettings m) {
    real square = x * x + y * y;
    real radius = sqrt(square);
    boolean isBeyond = radius > real(1.0);
    real px = select(isBeyond, x / select(isBeyond, radius, real(1.0)), x);
    real py = select(isBeyond, y / select(isBeyond, radius, real(1.0)), y);
    real p2 = minOf(square, real(1.0));
    real q = sqrt(real(1.0) - p2);
    // Towards the ball (px tau, py tau, -1), of length sqrt(a); the normal there.
    real tau = m.k / m.root;
    real a = real(1.0) + p2 * (tau * tau);
    real across = (real(1.0) - m.k * q) / (m.root * a);
    real normalZ = (q + m.k * p2 / (m.root * m.root)) / a;
    real twice = real(2.0) * q;
    real scale = real(1.0) / sqrt(a);
    return vec3(px * ((tau + twice * across) * scale), py * ((tau + twice * across) * scale),
                (twice * normalZ - real(1.0)) * scale);
}

// The point of the square [-1, 1]^2 that shows the unit direction d [Clarberg2008]: +Z in the middle, -Z in the
// corners, equal areas for equal solid angles.
vec2 octahedralPoint(vec3 d) {
    real ring = sqrt(d.x * d.x + d.y * d.y);
    // sqrt(1 - |z|)
    real radius = minOf(ring / sqrt(real(1.0) + absOf(d.z)), real(1.0));
    real across = radius * (atan2Of(absOf(d.y), absOf(d.x)) * real(0.6366197723675814));
    real along = radius - across;
    boolean isFront = d.z >= real(0.0);
    real x = select(isFront, along, real(1.0) - across);
    real y = select(isFront, across, real(1.0) - along);
    return vec2(select(d.x < real(0.0), -x, x), select(d.y < real(0.0), -y, y));
}
vec3 octahedralDirection(real x, real y) {
    real ax = absOf(x);
    real ay = absOf(y);
    real height = real(1.0) - (ax + ay);
    real radius = real(1.0) - absOf(height);
    boolean isMiddle = !(radius > real(0.0));
    real share = (ay - ax) / select(isMiddle, real(1.0), radius) + real(1.0);
    real turn_rad = select(isMiddle, real(0.0), share) * real(0.7853981633974483);
    real square = radius * radius;
    real ring = radius * sqrt(real(2.0) - square);
    real dx = ring * cosOf(turn_rad);
    real dy = ring * sinOf(turn_rad);
    real dz = real(1.0) - square;
    return vec3(select(x < real(0.0), -dx, dx), select(y < real(0.0), -dy, dy),
                select(height < real(0.0), -dz, dz));
}

// Longitude and latitude as sines and cosines.
vec3 latLongDirection(real sinLongitude, real cosLongitude, real sinLatitude, real cosLatitude) {
    return vec3(sinLongitude * cosLatitude, sinLatitude, cosLongitude * cosLatitude);
}

// [Pedersen2008, Listing 6.1]; s to the right and t upwards on the image, both in [0, 1].
vec3 listingDirection(real s, real t) {
    real theta_rad = real(6.283185307179586) * s;
    real phi_rad = t * real(3.141592653589793);
    real ring = sinOf(phi_rad);
    return vec3(ring * cosOf(theta_rad), -cosOf(phi_rad), -(ring * sinOf(theta_rad)));
}

// The axes of latLong's frame in that of the listing, and back.
vec3 listingAxes(vec3 d) { return vec3(-d.z, d.y, -d.x); }

vec3 directionOfLengthOne(vec3 d) {
    real square = d.x * d.x + (d.y * d.y + d.z * d.z);
    real scale = real(1.0) / sqrt(select(square > real(0.0), square, real(1.0)));
    return vec3(d.x * scale, d.y * scale, d.z * scale);
}

// The point of a lat-long image.
MappingPoint pointOfLatLong(LatLongCoordinates c) {
    MappingPoint p;
    p.layer = integer(0);
    p.u = c.u;
    p.v = c.v;
    p.isShown = boolean(true);
    return p;
}

// Where direction d, of any length, is shown.
MappingPoint mappingPoint(vec3 d, MappingSettings m) {
    if (m.mapping == 0) return pointOfLatLong(latLongCoordinates(d));
    if (m.mapping == 5) return pointOfLatLong(latLongCoordinates(listingAxes(d)));
    MappingPoint p;
    p.layer = integer(0);
    p.isShown = boolean(true);
    if (m.mapping == 1) {
        CubeCoordinates c = cubeCoordinates(d);
        p.layer = c.face;
        p.u = c.s;
        p.v = c.t;
        return p;
    }
    vec2 q = vec2(real(0.0), real(0.0));
    if (m.mapping == 2) q = angularPoint(d);
    if (m.mapping == 3) {
        vec3 unit = directionOfLengthOne(d);
        q = ballPoint(unit, m);
        p.isShown = isOnBall(unit, m);
    }
    if (m.mapping == 4) q = octahedralPoint(directionOfLengthOne(d));
    p.u = imageU(q.x);
    p.v = imageV(q.y);
    return p;
}

// The direction that a layer shows at u and v; of length one but for the cube, where its largest component is 1 or -1.
vec3 mappingDirection(integer layer, real u, real v, MappingSettings m) {
    if (m.mapping == 1) return cubeDirection(layer, u, v);
    if (m.mapping == 5) return listingDirection(u, real(1.0) - v);
    if (m.mapping == 0) {
        real longitude_rad = real(6.283185307179586) * (real(0.5) - u);
        real latitude_rad = real(3.141592653589793) * (real(0.5) - v);
        return latLongDirection(sinOf(longitude_rad), cosOf(longitude_rad), sinOf(latitude_rad),
                                cosOf(latitude_rad));
    }
    real x = real(2.0) * u - real(1.0);
    real y = real(1.0) - real(2.0) * v;
    if (m.mapping == 2) return angularDirection(x, y);
    if (m.mapping == 3) return ballDirection(x, y, m);
    return octahedralDirection(x, y);
}

// Solid angle per area of the square [-1, 1]^2 at a point of a disc or of the octahedral square.
real discDensity(real x, real y, MappingSettings m) {
    if (m.mapping == 4) return real(3.141592653589793);
    real square = x * x + y * y;
    if (m.mapping == 2) {
        // pi sin(pi r) / r
        real radius = sqrt(square);
        boolean isMiddle = !(radius > real(0.0));
        real s = absOf(sinOf(real(3.141592653589793) * minOf(radius, real(1.0))));
        return select(isMiddle, real(9.869604401089358),
                      real(3.141592653589793) * (s / select(isMiddle, real(1.0), radius)));
    }
    if (m.newtonSteps == 0) return real(4.0);
    // With Theta the polar angle of the direction and b that of the normal: sin(Theta) / r dTheta/db db/dr, whose
    // terms are those of ballDirection. It grows without limit towards the rim.
    real p2 = minOf(square, real(1.0));
    real q = sqrt(real(1.0) - p2);
    real tau = m.k / m.root;
    real a = real(1.0) + p2 * (tau * tau);
    real near = real(1.0) - m.k * q;
    real normalZ = (q + m.k * p2 / (m.root * m.root)) / a;
    real toEye2 = (real(1.0) + m.k * m.k) - real(2.0) * m.k * normalZ;
    real sineOverRadius = (tau + real(2.0) * q * (near / (m.root * a))) / sqrt(a);
    real perNormal = real(2.0) + m.k * (q * near / (a * toEye2));
    return sineOverRadius * perNormal * (near / (a * (m.root * maxOf(q, real(0.0009765625)))));
}
