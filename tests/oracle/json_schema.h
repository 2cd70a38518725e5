#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Validates documents by the part of JSON Schema draft 7 that the project's own schemas use. An
// unknown keyword is reported as an error, so that no condition is passed over in silence.
namespace assay::oracle {

class JsonSchema {
 public:
  using Json = nlohmann::json;

  explicit JsonSchema(Json schema) : root_(std::move(schema)) {}

  // Returns the document's breaches of the schema, each with its JSON pointer. Empty means valid.
  std::vector<std::string> Errors(const Json& document) const {
    return Errors(root_, document, "");
  }

 private:
  using Texts = std::vector<std::string>;

  static bool HasOneOf(const Json& value, const Json& types) {
    if (types.is_string()) return HasType(value, types.get<std::string>());
    return std::ranges::any_of(
        types, [&](const Json& type) { return HasType(value, type.get<std::string>()); });
  }
  static bool HasType(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "integer") {
      return value.is_number_integer() ||
             (value.is_number() && std::floor(value.get<double>()) == value.get<double>());
    }
    return type == "null" && value.is_null();
  }

  Texts Errors(const Json& schema, const Json& value, const std::string& at) const {
    if (schema.is_boolean()) return schema.get<bool>() ? Texts{} : Texts{at + ": not allowed"};
    Texts errors;
    for (const auto& [keyword, argument] : schema.items()) {
      for (const std::string& error : KeywordErrors(schema, keyword, argument, value, at)) {
        errors.push_back(error);
      }
    }
    return errors;
  }

  bool IsValid(const Json& schema, const Json& value) const {
    return Errors(schema, value, "").empty();
  }

  Texts KeywordErrors(const Json& schema, const std::string& keyword, const Json& argument,
                      const Json& value, const std::string& at) const {
    const auto unless = [&](bool holds) {
      return holds ? Texts{} : Texts{at + ": breaks " + keyword + " " + argument.dump()};
    };
    if (keyword == "$ref") {
      return Errors(root_.at(Json::json_pointer(argument.get<std::string>().substr(1))), value, at);
    }
    if (keyword == "type") return unless(HasOneOf(value, argument));
    if (keyword == "const") return unless(value == argument);
    if (keyword == "enum") return unless(std::ranges::count(argument, value) > 0);
    if (keyword == "minimum") return unless(!value.is_number() || value >= argument);
    if (keyword == "minItems") return unless(!value.is_array() || value.size() >= argument);
    if (keyword == "maxItems") return unless(!value.is_array() || value.size() <= argument);
    if (keyword == "required") return unless(HasAll(value, argument));
    if (keyword == "not") return unless(!IsValid(argument, value));
    if (keyword == "oneOf") {
      const auto valid = [&](const Json& option) { return IsValid(option, value); };
      return unless(std::ranges::count_if(argument, valid) == 1);
    }
    if (keyword == "items") return ItemErrors(argument, value, at);
    if (keyword == "properties") return PropertyErrors(argument, value, at);
    if (keyword == "additionalProperties") return AdditionalErrors(schema, argument, value, at);
    if (keyword == "if") {
      const std::string branch = IsValid(argument, value) ? "then" : "else";
      return schema.contains(branch) ? Errors(schema[branch], value, at) : Texts{};
    }
    const Texts others = {"$schema", "title", "description", "definitions", "then", "else"};
    return std::ranges::count(others, keyword) > 0 ? Texts{} : Texts{"unknown keyword " + keyword};
  }

  static bool HasAll(const Json& value, const Json& keys) {
    return !value.is_object() || std::ranges::all_of(keys, [&](const Json& key) {
      return value.contains(key.get<std::string>());
    });
  }

  Texts ItemErrors(const Json& schema, const Json& value, const std::string& at) const {
    Texts errors;
    if (!value.is_array()) return errors;
    for (std::size_t i = 0; i < value.size(); ++i) {
      std::ranges::copy(Errors(schema, value[i], at + "/" + std::to_string(i)),
                        std::back_inserter(errors));
    }
    return errors;
  }

  Texts PropertyErrors(const Json& schemas, const Json& value, const std::string& at) const {
    Texts errors;
    if (!value.is_object()) return errors;
    for (const auto& [key, schema] : schemas.items()) {
      if (!value.contains(key)) continue;
      std::ranges::copy(Errors(schema, value[key], at + "/" + key), std::back_inserter(errors));
    }
    return errors;
  }

  Texts AdditionalErrors(const Json& owner, const Json& schema, const Json& value,
                         const std::string& at) const {
    Texts errors;
    if (!value.is_object()) return errors;
    for (const auto& [key, item] : value.items()) {
      if (owner.contains("properties") && owner["properties"].contains(key)) continue;
      std::ranges::copy(Errors(schema, item, at + "/" + key), std::back_inserter(errors));
    }
    return errors;
  }

  Json root_;
};

}  // namespace assay::oracle
