#include "files/json.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "numeric/check.h"

using namespace etalon;

TEST_CASE("JsonIsIndentedAndKeepsTheOrderOfItsKeys") {
    Json json = {{"z", 1}, {"a", Json::list({true, nullptr, "x"})}};
    json["m"]["k"] = std::vector<double>{0.5, 1e300};
    json["z"] = -2;
    json["empty"] = Json::list();
    json["a"].append({{"b", Json()}});
    json["a"].back()["c"] = std::string("d");
    CHECK(jsonText(json) == R"({
  "z": -2,
  "a": [
    true,
    null,
    "x",
    {
      "b": null,
      "c": "d"
    }
  ],
  "m": {
    "k": [
      0.5,
      1e+300
    ]
  },
  "empty": []
}
)");
}

TEST_CASE("JsonNumbersKeepTheirValues") {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double real = 0.1 + 0.2;
    const auto read = nlohmann::json::parse(jsonText(Json::list(
        {INT64_MIN, UINT64_MAX, int8_t{-1}, size_t{7}, real, std::numeric_limits<double>::denorm_min(),
         Json::numberOf(real), Json::numberOf(kInfinity), Json::numberOf(-kInfinity),
         Json::numberOf(std::numeric_limits<double>::quiet_NaN()), kInfinity})));
    CHECK(read[0] == INT64_MIN);
    CHECK(read[1] == UINT64_MAX);
    CHECK(read[2] == -1);
    CHECK(read[3] == 7);
    CHECK(read[4] == real);
    CHECK(read[5] == std::numeric_limits<double>::denorm_min());
    CHECK(read[6] == real);
    CHECK(read[7] == "inf");
    CHECK(read[8] == "-inf");
    CHECK(read[9] == "nan");
    CHECK(read[10].is_null());
}

TEST_CASE("JsonReplacesBytesThatAreNoUtf8") {
    CHECK(jsonText("a\xff\"\n") == "\"a\uFFFD\\\"\\n\"\n");
    CHECK(jsonText({{"\xc3\xa9\xc3", 1}}) == "{\n  \"\u00e9\uFFFD\": 1\n}\n");
}

TEST_CASE("JsonListsHaveNoKeysAndObjectsNoEnd") {
    Json list = Json::list({1}), object = {{"a", 1}}, number = 1;
    CHECK_THROWS_AS(list["a"], PreconditionError);
    CHECK_THROWS_AS(number["a"], PreconditionError);
    CHECK_THROWS_AS(object.append(1), PreconditionError);
    CHECK_THROWS_AS(Json().append(1), PreconditionError);
}
