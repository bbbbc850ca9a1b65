// The distance of a point along the view, in metres: what the channel Z of an image holds.
// needs: numeric/kernels/vector.glsl
// p: the point; eye: where it is seen from; forward: unit vector along the optical axis.
real viewDepth(vec3 p, vec3 eye, vec3 forward) { return dot3(sub3(p, eye), forward); }
