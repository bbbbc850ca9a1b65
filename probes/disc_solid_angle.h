// Solid angles of the texels of images that are discs.
#pragma once

#include <vector>

#include "probes/mapping.h"

namespace etalon {

// Of the upper left quarter of the texels, (size + 1) / 2 squared, in steradians; the others are mirror
// images.
//
// With G(r) = 1 - cos(polar angle at radius r), a region of the disc has the solid angle of the integral of G
// dphi along its border, counterclockwise. Along an edge at height Y that is Y times the integral of G / r^2
// dx, which is 2 for the orthographic mirror ball and else takes Gauss-Legendre quadrature; along the rim it
// is G(1) dphi. Texels that share an edge share the edge's number, so that their sum is that of the rim but
// for rounding.
std::vector<double> discSolidAngles_sr(const ProbeShape& shape);

// G / r^2 at a point of the unit disc, of the angular map or a mirror ball.
double discTerm(double x, double y, bool isAngular, const MappingKernel<double>::MappingSettings& settings);

}  // namespace etalon
