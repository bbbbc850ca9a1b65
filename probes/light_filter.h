// Lights over a sequence of frames: which light of one frame is which of the next, how much they flicker, and
// a low-pass filter against it [Pedersen2008, ch. 7] [Havran2005].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "probes/probe_light.h"

namespace etalon {

// Directions further apart than this are not taken for the same light.
inline constexpr double kMaxLightMotion_rad = 0.7853981633974483;  // pi / 4

// Pairs (index in a, index in b), each light in at most one pair, in the order of a. The pairs are those of
// the cheapest transport of the energies (energyOf) from a to b, where a unit of energy costs the square of
// the chord between the directions, and half the square of the chord of maxMotion_rad where it vanishes or
// appears. Lights without energy, and lights further apart than maxMotion_rad, are in no pair. Deterministic:
// the same lights in the same order have the same pairs. maxMotion_rad in (0, pi]. Time: the square of the
// smaller number of lights times the larger.
std::vector<std::pair<size_t, size_t>> matchLights(std::span<const ProbeLight> a,
                                                   std::span<const ProbeLight> b,
                                                   double maxMotion_rad = kMaxLightMotion_rad);

// How much lights change from one frame to the next.
//   angle_rad: the mean angle between the directions of the pairs, weighted by the smaller energy of the two;
//     0 without pairs
//   intensity: the sum of |change of energy|, of lights in no pair all of it, relative to the mean of both
//     frames' energies: 0 for equal lights, 2 if none is in a pair; 0 if both frames are black
struct Flicker {
    double angle_rad = 0, intensity = 0;
};
Flicker flickerBetween(std::span<const ProbeLight> a, std::span<const ProbeLight> b,
                       double maxMotion_rad = kMaxLightMotion_rad);
// The means over the steps of a sequence; 0 for fewer than two frames.
Flicker meanFlicker(std::span<const std::vector<ProbeLight>> frames,
                    double maxMotion_rad = kMaxLightMotion_rad);

struct TrackedLight {
    uint64_t id = 0;  // the same over the frames, never used again
    ProbeLight light;
};

// A low-pass filter of the first order. With `blend` b in (0, 1], after each frame a light's energy is
// (1 - b) times what it was plus b times that of its partner in the frame, likewise its direction (then of
// length 1; the partner's if they cancel) and its position (the partner's where only one has a position). A
// light that appears starts from no energy where it is first seen, one that vanishes fades where it was last,
// until its energy is below kFadedLight of the frame's, then it is dropped. So the total energy is that of
// the frames under the same filter, but for what is dropped. b = 1 passes the frames on, b = 1 - exp(-dt /
// tau) has the time constant tau at a frame interval dt. Partners are those of matchLights between a frame
// and the one before it.
class LightFilter {
  public:
    static constexpr double kFadedLight = 0x1p-20;

    explicit LightFilter(double blend, double maxMotion_rad = kMaxLightMotion_rad);

    // The filtered lights after the next frame: first those of earlier frames in the order of their ids, then
    // those that appear in the order of the frame. The first frame is passed on as it is.
    const std::vector<TrackedLight>& add(std::span<const ProbeLight> frame);

  private:
    double blend_, maxMotion_rad_;
    uint64_t nextId_ = 0;
    bool started_ = false;
    std::vector<TrackedLight> tracks_;   // in the order of their ids
    std::vector<ProbeLight> lastFrame_;  // the partners of the tracks with the ids below
    std::vector<uint64_t> lastIds_;
};

}  // namespace etalon
