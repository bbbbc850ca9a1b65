// What a point of a surface reflects of the lights.
// needs: numeric/kernels/vector.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_pow.glsl
// needs: lighting/kernels/checker.glsl
// needs: lighting/kernels/lambert.glsl
// needs: lighting/kernels/blinn_phong.glsl
// needs: lighting/kernels/positional_light.glsl
// needs: lighting/kernels/surface_point.glsl
// needs: lighting/kernels/reflectances.glsl
// needs: lighting/kernels/light_scope.glsl

struct Reflected {
    vec3 diffuse;
    vec3 specular;
};

// Whether a condition holds in every lane.
bool isEverywhere(boolean c) { return !isAny(!c); }
// Infinities and NaN have no difference to themselves.
boolean isFinite(real a) { return a - a == real(0.0); }
boolean isFinite3(vec3 a) { return isFinite(a.x) && isFinite(a.y) && isFinite(a.z); }

// The sum over the lights in their order, from 0: each light's irradiance, of a positional one what arrives
// (lighting/kernels/positional_light.glsl), times its visibility. albedo: the diffuse reflectance. Components that are
// not asked for are 0.
//
// A light behind the surfaces of all lanes is left out: it would add zeros to sums that are not below 0. That holds
// where its irradiance, the direction to the eye and the lobe's scale are finite; elsewhere 0 times infinity is a NaN that
// must be seen, and so the light is added.
Reflected reflectedOfLights(bool diffuse, bool specular, SurfacePoint p, Reflectances r, vec3 albedo,
                            LightBuffer lights, VisibilityBuffer shadows) {
    vec3 diffuseSum = vec3(real(0.0), real(0.0), real(0.0));
    vec3 specularSum = diffuseSum;
    bool hasZeros = isEverywhere(isFinite3(p.toEye) && isFinite(r.lobeScale));
    int count = lightCount(lights);
    for (int l = 0; l < count; l++) {
        Light light = lightAt(lights, l);
        vec3 toLight = light.place;
        vec3 irradiance = light.power;
        bool addsZeros = hasZeros && light.isFinite != 0;
        if (light.kind != 0) {
            ArrivingLight arriving = pointLight(light.place, p.position);
            real part = arriving.perIntensity;
            if (light.kind == 2) {
                LightCone cone = coneAt(lights, l);
                part = part * spotPart(arriving.toLight, cone.axis, cone.cosInner, cone.cosOuter);
            }
            toLight = arriving.toLight;
            irradiance = scale3(light.power, part);
            addsZeros = hasZeros && isEverywhere(isFinite3(irradiance));
        }
        bool isBehind = isEverywhere(dot3(p.normal, toLight) <= real(0.0));
        if (!(isBehind && addsZeros)) {
            if (light.shadowRow >= 0) irradiance = scale3(irradiance, visibilityOf(shadows, light.shadowRow));
            if (diffuse) diffuseSum = add3(diffuseSum, lambert(p.normal, toLight, irradiance, albedo));
            if (specular)
                specularSum = add3(specularSum, blinnPhong(p.normal, p.toEye, toLight, irradiance, r.specular,
                                                           r.exponent, r.lobeScale));
        }
    }
    Reflected sums;
    sums.diffuse = diffuseSum;
    sums.specular = specularSum;
    return sums;
}
