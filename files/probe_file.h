// Light probes as image files.
//
// Which mapping a file has is told by the caller, or by the file: Etalon's own attributes, OpenEXR's envmap
// attribute, or the shape of the image: 2:1 is a lat-long map, 1:6 a strip of cube faces in OpenEXR's layout,
// 4:3 and 3:4 crosses. A square image may be an angular map, a mirror ball or octahedral, and must be told.
//
// Attributes of EXR files that Etalon writes, besides envmap: "etalon.mapping" (a name of probes/names.h),
// "etalon.ballDistance" (radii, or inf), "etalon.rotation" (nine
// numbers, the rows of the matrix from the probe's frame to the world), "etalon.position" (metres). Channels
// "distance" (metres) and "valid" (0 or 1) belong to the probe where they are present.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/frame.h"
#include "probes/cube_layout.h"
#include "probes/probe.h"

namespace etalon {

// What the caller knows about a file; what is not given is taken from the file.
struct ProbeFileOptions {
    std::optional<Mapping> mapping;
    std::optional<CubeLayout> layout;  // of a cube's file
    std::optional<double> ballDistance_radii;
};

// The probe in a file. InputError "path: reason" as readRgb (files/image_io.h), for an image whose shape does
// not fit the mapping, and for attributes that are not what they should be.
Probe loadProbe(const std::filesystem::path& path, const ProbeFileOptions& options = {});

// The probe as the channels of an EXR file (encodeExr); a cube in the given layout.
Frame frameOfProbe(const Probe& probe, CubeLayout layout = CubeLayout::openExrStrip);

}  // namespace etalon
