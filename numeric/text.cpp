#include "numeric/text.h"

#include <fmt/args.h>
#include <fmt/format.h>

namespace etalon {

std::string formatValues(const char* format, const TextValue* values, size_t count) {
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    for (const TextValue* value = values; value != values + count; value++) {
        switch (value->kind) {
            case TextValue::Kind::boolean:
                store.push_back(value->boolean);
                break;
            case TextValue::Kind::character:
                store.push_back(value->character);
                break;
            case TextValue::Kind::signedInteger:
                store.push_back(value->signedInteger);
                break;
            case TextValue::Kind::unsignedInteger:
                store.push_back(value->unsignedInteger);
                break;
            case TextValue::Kind::single:
                store.push_back(value->single);
                break;
            case TextValue::Kind::real:
                store.push_back(value->real);
                break;
            case TextValue::Kind::string:
                store.push_back(fmt::string_view(value->string.data(), value->string.size()));
                break;
        }
    }
    return fmt::vformat(format, store);
}

}  // namespace etalon
