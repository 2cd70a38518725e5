#include "sim/python/python_object.h"

#include <nlohmann/json.hpp>
#include <string>

namespace assay::python {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

py::object ToPython(const Json& json) {
  switch (json.type()) {
    case Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[py::str(key)] = ToPython(value);
      return dict;
    }
    case Json::value_t::array: {
      py::list list;
      for (const Json& item : json) list.append(ToPython(item));
      return list;
    }
    case Json::value_t::string:
      return py::str(json.get_ref<const std::string&>());
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case Json::value_t::number_float:
      return py::float_(json.get<double>());
    case Json::value_t::null:
    case Json::value_t::binary:
    case Json::value_t::discarded:
      break;
  }
  return py::none();
}

}  // namespace assay::python
