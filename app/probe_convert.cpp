#include <limits>
#include <memory>

#include "app/options.h"
#include "app/verbs.h"
#include "files/atomic_file.h"
#include "files/image_io.h"
#include "numeric/text.h"
#include "numeric/transform.h"
#include "probes/convert.h"
#include "probes/probe_statistics.h"
#include "scene/profile_file.h"
#include "scene/toml_reader.h"

namespace etalon {
namespace {

struct ProbeConvertVerb {
    ProbeInput input;
    std::string output, to, toLayout = "openexr", resampling = std::string(nameOf(Resampling::area)),
                            profile = "f32";
    int width = 0, height = 0, threads = 0;
    double toBallDistance_radii = std::numeric_limits<double>::infinity(), rotation_deg = 0;
    bool upright = false;
};

// Where nothing is given, as many texels across the horizon as the source has.
int widthAcross(const ProbeShape& source, Mapping to) {
    const int horizon = isLatLong(source.mapping)         ? source.width
                        : source.mapping == Mapping::cube ? 4 * source.width
                                                          : 2 * source.width;
    const int width = isLatLong(to) ? horizon : to == Mapping::cube ? horizon / 4 : horizon / 2;
    return std::max(1, width);
}

ProbeShape shapeOf(const ProbeConvertVerb& verb, const Probe& source) {
    ProbeShape shape;
    shape.mapping = *memberOf<Mapping>(verb.to);
    shape.width = verb.width > 0 ? verb.width : widthAcross(source.shape, shape.mapping);
    shape.height = isLatLong(shape.mapping) ? std::max(1, shape.width / 2) : shape.width;
    if (verb.height > 0) shape.height = verb.height;
    if (!isLatLong(shape.mapping) && shape.height != shape.width)
        throw InputError(
            formatText("--height {}: images of the mapping {} are square", shape.height, verb.to));
    shape.ballDistance_radii = verb.toBallDistance_radii;
    return shape;
}

// Of points of a source whose texels are finer somewhere.
void warnOfPointSampling(const ProbeConvertVerb& verb, const Probe& source, const ProbeConversion& conversion,
                         const Probe& result) {
    if (conversion.resampling == Resampling::area) return;
    const double minification = minificationOf(source, conversion);
    if (!(minification > kMinified)) return;
    const auto mean = [&](const Probe& probe) {
        const glm::dvec3 rgb = statisticsOf(probe, verb.threads).mean;
        return (rgb.x + rgb.y + rgb.z) / 3.0;
    };
    printText(
        stderr,
        "etalon: warning: {}: {} takes points of the source, whose texels are up to {:.3g} times as fine as "
        "the result's: the mean radiance was {:.6g} and is {:.6g}; --resample area keeps it\n",
        printable(verb.input.file), verb.resampling, minification, mean(source), mean(result));
}

ExitCode runProbeConvert(const ProbeConvertVerb& verb) {
    if (std::filesystem::path(verb.output).extension() != ".exr")
        throw InputError(formatText("{}: probes are written as EXR files; name it .exr", verb.output));
    AtomicFile file(verb.output);
    ProgressLine progress;
    const Probe source = verb.input.load(progress);
    ProbeConversion conversion;
    conversion.shape = shapeOf(verb, source);
    conversion.resampling = *memberOf<Resampling>(verb.resampling);
    const Profile profile = loadProfile(verb.profile);
    conversion.fractionBits = profile.textureFractionBits;
    conversion.rule = profile.filterRule;
    // The frame of the result, about +Y from that of the source or of the world.
    const SinCos turn = sinCosOfDegrees(verb.rotation_deg);
    const glm::dmat3 aboutY(turn.cos, 0, -turn.sin, 0, 1, 0, turn.sin, 0, turn.cos);
    const glm::dmat3 from = verb.upright ? glm::dmat3(1) : source.rotation;
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++)
            conversion.rotation[c][r] =
                from[0][r] * aboutY[c][0] + (from[1][r] * aboutY[c][1] + from[2][r] * aboutY[c][2]);
    const Probe result = progress.during(
        "converting", [&] { return convertProbe(source, conversion, profile.fragment, verb.threads); });
    file.write(progress.during("writing " + printable(verb.output), [&] {
        return encodeExr(frameOfProbe(result, *memberOf<CubeLayout>(verb.toLayout)), verb.threads);
    }));
    file.commit();
    progress.finish();
    warnOfPointSampling(verb, source, conversion, result);
    return ExitCode::done;
}

}  // namespace

void addProbeConvert(Verb& probe) {
    const auto options = std::make_shared<ProbeConvertVerb>();
    Verb& verb = probe.addVerb("convert", "Convert a probe to another mapping, size or orientation");
    options->input.addTo(verb);
    verb.add("-o,--output", options->output, "EXR file to write").required();
    verb.add("--to", options->to, "Mapping of the result").required().oneOf(kNames<Mapping>);
    verb.add("--width", options->width, "Texels across an image (a cube's face); default: as in the source")
        .range(1, kMaxImageSize);
    verb.add("--height", options->height, "Texels down a lat-long image; default: half the width")
        .range(1, kMaxImageSize);
    verb.add("--to-layout", options->toLayout, "How the faces of a cube are laid out")
        .oneOf(kNames<CubeLayout>);
    verb.add("--to-ball-distance", options->toBallDistance_radii, "Of a mirror ball, in radii")
        .range(kLeastBallDistance_radii, std::numeric_limits<double>::infinity());
    verb.add("--resample", options->resampling,
             "area: means over texels, keeps energy; bilinear, nearest: points of the source, for smooth or "
             "unchanged texels where the result is no coarser")
        .oneOf(kNames<Resampling>);
    verb.add("--rotate-y-deg", options->rotation_deg,
             "Turn the frame of the result about +Y, counter-clockwise from above")
        .range(-1e6, 1e6);
    verb.addFlag("--upright", options->upright,
                 "The result is in world axes; default: in those of the source");
    verb.add("--profile", options->profile, "Arithmetic profile: a name (etalon profiles) or a TOML file");
    addIsaOption(verb);
    addThreadsOption(verb, options->threads);
    verb.onRun([options] { return runProbeConvert(*options); });
}

}  // namespace etalon
