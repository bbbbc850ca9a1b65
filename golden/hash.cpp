#include "golden/hash.h"

#include <algorithm>
#include <bit>

#include "numeric/hash.h"
#include "numeric/text.h"

namespace etalon {
namespace {

template <class T>
void addSamples(Xxh64& hash, const Image<T>& image) {
    if constexpr (std::endian::native == std::endian::little)
        hash.add(std::as_bytes(image.values()));
    else
        for (const T value : image.values()) hash.addNumber(std::bit_cast<uint32_t>(value));
}

}  // namespace

std::string hashChannels(int width, int height, std::vector<const Channel*> channels) {
    std::ranges::sort(channels, {}, &Channel::name);
    Xxh64 hash;
    hash.addText("etalon-pixels-1");
    hash.addNumber(static_cast<uint32_t>(width));
    hash.addNumber(static_cast<uint32_t>(height));
    hash.addNumber(static_cast<uint32_t>(channels.size()));
    for (const Channel* channel : channels) {
        hash.addText(channel->name);
        hash.addText(std::holds_alternative<Image<float>>(channel->values) ? "float" : "uint32");
        std::visit([&](const auto& image) { addSamples(hash, image); }, channel->values);
    }
    return formatText("{:016x}", hash.digest());
}

std::string hashFrame(const Frame& frame) {
    checkFrame(frame);
    std::vector<const Channel*> channels;
    for (const Channel& channel : frame.channels) channels.push_back(&channel);
    return hashChannels(frame.width, frame.height, std::move(channels));
}

}  // namespace etalon
