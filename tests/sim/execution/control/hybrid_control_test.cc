#include "sim/execution/control/hybrid_control.h"

#include <gtest/gtest.h>

namespace assay::execution::hybrid_control_test {
namespace {

// Makes a strategy whose motions each have their own contacts, as planners write them.
class Contacts {
 public:
  int Named(const std::string& name) {
    strategy_.contacts.push_back({name, Vector3::UnitZ(), Vector3::Zero()});
    return static_cast<int>(strategy_.contacts.size()) - 1;
  }
  void Go(const std::vector<std::string>& kept, const std::string& until = {}) {
    plan::StrategyMotion motion;
    for (const std::string& name : kept) motion.kept.push_back(Named(name));
    if (!until.empty()) motion.until = Named(until);
    strategy_.motions.push_back(motion);
  }
  const plan::Strategy& strategy() const { return strategy_; }

 private:
  plan::Strategy strategy_;
};

TEST(HybridControl, LetsGoOfContactsByTheirNames) {
  Contacts contacts;
  contacts.Go({}, "a");
  contacts.Go({"a"}, "b");
  contacts.Go({"b", "a"});
  contacts.Go({"b"}, "c");
  contacts.Go({"b"});
  contacts.Go({});
  contacts.Go({});
  const std::vector<bool> lets_go = {false, false, false, true, true, true, false};
  for (std::size_t i = 0; i < lets_go.size(); ++i)
    EXPECT_EQ(LetsGo(contacts.strategy(), i), lets_go[i]) << i;
}

}  // namespace
}  // namespace assay::execution::hybrid_control_test
