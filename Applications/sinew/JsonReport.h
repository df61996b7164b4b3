#pragma once

#include <nlohmann/json.hpp>

namespace sinew {

using Json = nlohmann::ordered_json;  // keeps the order in which fields are written

/// `program` and `version`, with which every result begins.
Json programFields();

/// The text of a result: two spaces of indent, a newline at the end. What is not UTF-8 is replaced.
std::string document(const Json& json);

}  // namespace sinew
