// What a point of a surface shows. Its components are sums of their own; they add up in the order ambient, diffuse,
// specular, mirror. With the blurred reflective map as the environment's light this is the final shader of
// [Karlsson2005, sec. 3.3]: ambient light times albedo, plus diffuse map times albedo, plus the specular lobe of each
// light, plus reflective map times mirror reflectance.
// needs: numeric/kernels/vector.glsl
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_pow.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: probes/kernels/flux_scope.glsl
// needs: probes/kernels/flux.glsl
// needs: probes/kernels/irradiance.glsl
// needs: probes/kernels/irradiance_scope.glsl
// needs: probes/kernels/irradiance_sums.glsl
// needs: probes/kernels/harmonics_scope.glsl
// needs: probes/kernels/harmonics.glsl
// needs: lighting/kernels/checker.glsl
// needs: lighting/kernels/lambert.glsl
// needs: lighting/kernels/blinn_phong.glsl
// needs: lighting/kernels/positional_light.glsl
// needs: lighting/kernels/surface_point.glsl
// needs: lighting/kernels/reflectances.glsl
// needs: lighting/kernels/light_scope.glsl
// needs: lighting/kernels/surface_light.glsl
// needs: lighting/kernels/environment_scope.glsl
// needs: lighting/kernels/environment_light.glsl

// Which components are evaluated; the others are 0.
struct SurfaceParts {
    bool ambient;
    bool diffuse;
    bool specular;
    bool mirror;
    bool isOccluded;   // by its surroundings; else all of them are seen
    bool isPerVertex;  // what lights give is interpolated from the vertices
};
// What a point sees of its surroundings (lighting/occlusion.h).
struct Surroundings {
    real open;
    vec3 bentNormal;
};
struct SurfaceRadiance {
    vec3 ambient;
    vec3 diffuse;
    vec3 specular;
    vec3 mirror;
    vec3 beauty;  // their sum
};

// Of lights and environment, the latter last and diffusely alone: its irradiance in the normal or, where surroundings
// occlude it, in the bent normal times what is open. Of vertices and of fragments.
Reflected reflectedLight(SurfaceParts parts, SurfacePoint p, Reflectances r, vec3 albedo, Surroundings s,
                         LightBuffer lights, VisibilityBuffer shadows) {
    Reflected sum = reflectedOfLights(parts.diffuse, parts.specular, p, r, albedo, lights, shadows);
    if (parts.diffuse && environmentKind() != 0) {
        vec3 irradiance;
        if (parts.isOccluded)
            irradiance = scale3(environmentIrradiance(s.bentNormal), s.open);
        else
            irradiance = environmentIrradiance(p.normal);
        sum.diffuse = add3(sum.diffuse, lambertOfIrradiance(irradiance, albedo));
    }
    return sum;
}

// The composition. ambient: radiance from everywhere; mirrored: what the mirror shows.
SurfaceRadiance composed(SurfaceParts parts, Reflectances r, vec3 albedo, Surroundings s, vec3 ambient, Reflected lit,
                         vec3 mirrored) {
    vec3 none = vec3(real(0.0), real(0.0), real(0.0));
    SurfaceRadiance c;
    c.ambient = none;
    c.diffuse = none;
    c.specular = none;
    c.mirror = none;
    c.beauty = none;
    if (parts.ambient) {
        vec3 arriving = ambient;
        if (parts.isOccluded) arriving = scale3(ambient, s.open);
        c.ambient = mul3(albedo, arriving);
        c.beauty = add3(c.beauty, c.ambient);
    }
    if (parts.diffuse) {
        c.diffuse = lit.diffuse;
        c.beauty = add3(c.beauty, c.diffuse);
    }
    if (parts.specular) {
        c.specular = lit.specular;
        c.beauty = add3(c.beauty, c.specular);
    }
    if (parts.mirror) {
        c.mirror = mul3(r.mirror, mirrored);
        c.beauty = add3(c.beauty, c.mirror);
    }
    return c;
}

// ofVertices: what the vertices reflect, interpolated; read where parts say so, as lights and shadows are elsewhere.
SurfaceRadiance surfaceRadiance(SurfaceParts parts, SurfacePoint p, Reflectances r, vec3 albedo, Surroundings s,
                                vec3 ambient, LightBuffer lights, VisibilityBuffer shadows, Reflected ofVertices,
                                vec3 mirrored) {
    Reflected lit = ofVertices;
    if (!parts.isPerVertex && (parts.diffuse || parts.specular))
        lit = reflectedLight(parts, p, r, albedo, s, lights, shadows);
    return composed(parts, r, albedo, s, ambient, lit, mirrored);
}
