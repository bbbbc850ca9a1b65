// What the environment gives a plane, of everything that stands for it, for the outputs that show it alone.
// needs: numeric/kernels/vector.glsl
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
// needs: lighting/kernels/light_scope.glsl
// needs: lighting/kernels/environment_scope.glsl
// needs: lighting/kernels/environment_light.glsl

// W/m^2 on a plane with the unit normal n. open, bentNormal: what the plane sees of its surroundings: the light from
// everywhere is that in the bent normal, times what is open. lights: the directional ones that the environment is cut
// into, added in their order behind the rest, each times the part of it that reaches the plane where hasShadows.
vec3 receivedIrradiance(vec3 n, real open, vec3 bentNormal, LightBuffer lights, VisibilityBuffer shadows,
                        bool hasShadows) {
    vec3 sum = scale3(environmentIrradiance(bentNormal), open);
    int count = lightCount(lights);
    for (int l = 0; l < count; l++) {
        Light light = lightAt(lights, l);
        real reaching = real(1.0);
        if (hasShadows && light.shadowRow >= 0) reaching = visibilityOf(shadows, light.shadowRow);
        sum = addIrradiance(sum, n, light.place, scale3(light.power, reaching));
    }
    return sum;
}
