#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/sweep/database/database.h"

namespace assay::sweep {

// Returns all rows, as text, that must be equal for all runs of the same sweep. They are in the
// order of the tables.
inline std::map<std::string, std::vector<std::string>> Tables(const std::filesystem::path& file) {
  const Database database(file, Database::Access::kRead);
  const std::map<std::string, std::string> queries = {
      {"sweep", "SELECT quote(key) || quote(value) FROM sweep"},
      {"cell",
       "SELECT "
       "cell||'|'||scenario||'|'||quote(clearance)||quote(error_scale)||propagation||resolvers||"
       "noise||sensing||'|'||seed||'|'||trials||grasp||outcome||actions||'|'||errors||'|'||proved||"
       "quote(conflict)||quote(plan) FROM cell"},
      {"gate",
       "SELECT cell||'|'||id||quote(arm)||quote(penetration)||quote(lag)||quote(lag_turn) "
       "FROM gate"},
      {"gate_component",
       "SELECT cell||'|'||id||'|'||component||about||quote(name)||quote(offset)||quote(step_size) "
       "FROM gate_component"},
      {"claim",
       "SELECT cell||'|'||quote(claim)||step||quote(action)||about||quote(name)||unit||quote(low)||"
       "quote(high)||proved||quote(gate) FROM claim"},
      {"trial",
       "SELECT trial||'|'||cell||'|'||number||'|'||quote(noise)||outcome||quote(reason)||"
       "quote(simulated)||'|'||steps||'|'||errors_signalled||'|'||recovered||'|'||operator_called||"
       "quote(warnings)||contained||'|'||inconclusive||'|'||violated||'|'||not_claimed||replay "
       "FROM trial"},
      {"verdict",
       "SELECT "
       "trial||'|'||step||quote(action)||verdict||quote(claim)||quote(observed)||quote(low)||"
       "quote(high)||quote(margin)||quote(gate) FROM verdict"},
      {"observation", "SELECT trial||'|'||quote(claim)||quote(observed) FROM observation"},
      {"attack",
       "SELECT cell||'|'||attempts||'|'||contained||'|'||inconclusive||'|'||violated||'|'||"
       "not_claimed||'|'||claims_contained||'|'||claims_inconclusive||'|'||claims_violated||'|'||"
       "claims_not_claimed FROM attack"},
      {"attack_worst",
       "SELECT cell||'|'||quote(claim)||step||quote(action)||about||quote(name)||unit||"
       "quote(observed)||quote(low)||quote(high)||quote(margin)||quote(gate)||verdict||phase||"
       "attempt||quote(noise) FROM attack_worst"},
      {"counterexample",
       "SELECT cell||'|'||number||quote(claim)||quote(action)||quote(name)||unit||quote(observed)||"
       "quote(low)||quote(high)||quote(margin)||quote(gate)||quote(noise)||steps||'|'||replayed||"
       "quote(multiple)||quote(replay) FROM counterexample"},
      {"conservatism",
       "SELECT cell||'|'||quote(variable)||quote(guaranteed)||quote(broken)||quote(ratio) "
       "FROM conservatism"}};
  std::map<std::string, std::vector<std::string>> tables;
  for (const auto& [table, query] : queries) {
    Statement rows = database.Prepare(query);
    while (rows.Next()) tables[table].push_back(rows.Text(0));
  }
  return tables;
}

}  // namespace assay::sweep
