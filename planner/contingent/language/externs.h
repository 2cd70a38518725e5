#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// An outside procedure that a query calls, such as isReachable(location, robot). It must have no
// side effects. It is called once for each list of arguments, when the problem is grounded.
using Extern = std::function<bool(std::span<const std::string> arguments)>;

// The outside procedures by their names.
class Externs {
 public:
  void Add(const std::string& name, Extern procedure) { procedures_[name] = std::move(procedure); }

  // Adds the facts that the problem declares for externs. An extern without a procedure is true for
  // these facts alone.
  void AddFacts(const Problem& problem);

  // Returns the answer of the extern `name`. Throws InputError with the place of the call if the
  // procedure throws, or if there is none.
  bool Call(const std::string& name, const std::vector<std::string>& arguments,
            const FilePlace& place);

 private:
  bool CallProcedure(const std::string& name, const std::vector<std::string>& arguments,
                     const FilePlace& place) const;

  std::map<std::string, Extern> procedures_;
  std::map<std::string, std::map<std::vector<std::string>, bool>> answers_;
  std::map<std::string, bool> has_facts_;
};

}  // namespace assay::contingent
