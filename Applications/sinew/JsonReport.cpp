#include "JsonReport.h"

#include "sinew/Pipeline/Report.h"

namespace sinew {

Json programFields() { return {{"program", "sinew"}, {"version", version()}}; }

std::string document(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sinew
