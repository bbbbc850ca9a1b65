#include "bitcheck/reference.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "numeric/check.h"
#include "numeric/hash.h"
#include "numeric/text.h"

namespace etalon {
namespace {

constexpr std::string_view kFirstLine = "etalon bits 1";
constexpr int kHashDigits = 16;

template <class T>
std::optional<T> numberOf(std::string_view text, int base = 10) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// The lines of a text, one after the other.
class Lines {
  public:
    Lines(std::string_view text, const std::string& file) : rest_(text), file_(file) { next(); }

    // No whole line is left; isEmpty: nor is a part of one.
    bool atEnd() const { return atEnd_; }
    bool isEmpty() const { return rest_.empty(); }
    std::string_view line() const { return line_; }
    void next() {
        number_++;
        // A line without its line break was cut.
        const size_t length = rest_.find('\n');
        atEnd_ = length == std::string_view::npos;
        line_ = atEnd_ ? std::string_view() : rest_.substr(0, length);
        if (!atEnd_) rest_.remove_prefix(length + 1);
    }
    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError(formatText("{}:{}: {}", file_, number_, reason));
    }
    void requireLine(std::string_view what) const {
        if (atEnd_) fail(formatText("the file ends where {} should stand: it was cut", what));
    }
    // What follows "key " on this line.
    std::string_view valueOf(std::string_view key) const {
        requireLine(formatText("\"{}\"", key));
        if (!isKey(key)) fail(formatText("\"{}\" is missing", key));
        return line_.substr(key.size() + 1);
    }
    bool isKey(std::string_view key) const {
        return !atEnd_ && line_.starts_with(key) && line_.size() > key.size() + 1 && line_[key.size()] == ' ';
    }

  private:
    std::string_view rest_, line_;
    std::string file_;
    int number_ = 0;
    bool atEnd_ = false;
};

std::vector<std::string_view> wordsOf(std::string_view text, char separator) {
    std::vector<std::string_view> words;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(separator, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

uint64_t readHash(const Lines& lines, std::string_view text) {
    const auto hash = numberOf<uint64_t>(text, 16);
    if (text.size() != kHashDigits || !hash)
        lines.fail(formatText("\"{}\" is not a hash of {} hexadecimal digits", text, kHashDigits));
    return *hash;
}

PlaneHashes readPlane(Lines& lines) {
    const auto words = wordsOf(lines.valueOf("plane"), ' ');
    if (words.size() != 3) lines.fail("must be: plane NAME KIND WIDTHxHEIGHTxLAYERS");
    PlaneHashes plane;
    plane.name = words[0];
    std::optional<WordKind> kind;
    for (const WordKind k : {WordKind::uint32, WordKind::float32, WordKind::float64})
        if (words[1] == wordKindName(k)) kind = k;
    if (!kind) lines.fail(formatText("unknown kind \"{}\"", words[1]));
    plane.kind = *kind;
    const auto sizes = wordsOf(words[2], 'x');
    int* const fields[] = {&plane.width, &plane.height, &plane.layers};
    for (size_t i = 0; i < std::size(fields); i++) {
        const auto size = sizes.size() == std::size(fields) ? numberOf<int>(sizes[i]) : std::nullopt;
        if (!size || *size < 1 || *size > kMaxImageSize)
            lines.fail(formatText("\"{}\" is not a size", words[2]));
        *fields[i] = *size;
    }
    lines.next();
    for (int row = 0; row < plane.rows(); row++, lines.next()) {
        lines.requireLine("a row of hashes");
        const auto hashes = wordsOf(lines.line(), ' ');
        if (hashes.size() != static_cast<size_t>(plane.columns()))
            lines.fail(formatText("must be the {} hashes of a row of tiles", plane.columns()));
        for (const std::string_view hash : hashes) plane.tiles.push_back(readHash(lines, hash));
    }
    return plane;
}

CaseHashes readCase(Lines& lines) {
    CaseHashes c{std::string(lines.valueOf("case")), {}};
    lines.next();
    while (lines.isKey("plane")) {
        c.planes.push_back(readPlane(lines));
        for (size_t i = 0; i + 1 < c.planes.size(); i++)
            if (c.planes[i].name == c.planes.back().name)
                lines.fail(formatText("the plane \"{}\" stands there twice", c.planes[i].name));
    }
    if (c.planes.empty()) {
        lines.requireLine("\"plane\"");
        lines.fail(formatText("the case \"{}\" has no plane", c.name));
    }
    return c;
}

}  // namespace

const CaseHashes* BitReference::find(std::string_view name) const {
    const auto found = std::ranges::find(cases, name, &CaseHashes::name);
    return found == cases.end() ? nullptr : &*found;
}

CaseHashes hashCase(const std::string& name, const std::vector<BitPlane>& planes) {
    CaseHashes hashes{name, {}};
    for (const BitPlane& plane : planes) hashes.planes.push_back(hashPlane(plane));
    return hashes;
}

uint64_t hashOfAll(const std::vector<CaseHashes>& cases) {
    Xxh64 hash;
    for (const CaseHashes& c : cases) {
        hash.addText(c.name);
        hash.addNumber(static_cast<uint32_t>(c.planes.size()));
        for (const PlaneHashes& plane : c.planes) {
            hash.addText(plane.name);
            hash.addText(wordKindName(plane.kind));
            for (const int size : {plane.width, plane.height, plane.layers})
                hash.addNumber(static_cast<uint32_t>(size));
            for (const uint64_t tile : plane.tiles) hash.addNumber(tile);
        }
    }
    return hash.digest();
}

std::string referenceText(const BitReference& reference) {
    std::string text =
        formatText("{}\nrules {}\nreason {}\n", kFirstLine, reference.rulesVersion, reference.reason);
    for (const CaseHashes& c : reference.cases) {
        text += formatText("case {}\n", c.name);
        for (const PlaneHashes& plane : c.planes) {
            ETALON_CHECK(plane.name.find(' ') == std::string::npos, "a plane of {} is called \"{}\"", c.name,
                         plane.name);
            text += formatText("plane {} {} {}x{}x{}\n", plane.name, wordKindName(plane.kind), plane.width,
                               plane.height, plane.layers);
            for (size_t i = 0; i < plane.tiles.size(); i++) {
                const bool isLast = (i + 1) % static_cast<size_t>(plane.columns()) == 0;
                text += formatText("{:016x}{}", plane.tiles[i], isLast ? '\n' : ' ');
            }
        }
    }
    return text + formatText("all {:016x}\n", hashOfAll(reference.cases));
}

BitReference readReference(std::string_view text, const std::string& file) {
    Lines lines(text, file);
    if (lines.atEnd() || lines.line() != kFirstLine)
        lines.fail(formatText("the first line is not \"{}\"", kFirstLine));
    lines.next();
    BitReference reference;
    const auto rules = numberOf<int>(lines.valueOf("rules"));
    if (!rules) lines.fail("\"rules\" must be a whole number");
    reference.rulesVersion = *rules;
    lines.next();
    reference.reason = lines.valueOf("reason");
    lines.next();
    while (lines.isKey("case")) {
        CaseHashes c = readCase(lines);
        if (reference.find(c.name)) lines.fail(formatText("the case \"{}\" stands there twice", c.name));
        reference.cases.push_back(std::move(c));
    }
    if (readHash(lines, lines.valueOf("all")) != hashOfAll(reference.cases))
        lines.fail("\"all\" is not the hash of what stands above it: the file was changed or damaged");
    lines.next();
    if (!lines.atEnd() || !lines.isEmpty()) lines.fail("nothing may follow \"all\"");
    return reference;
}

}  // namespace etalon
