// SPDX-License-Identifier: MIT
// The bulk modulus that thin_wall_stabiliser leaves to the law, and the energies of bending that follow.
#include <hmps/terms/thin_wall_stabiliser.hpp>
#include <vector>

#include "fitted/scene.hpp"
#include "report/text.hpp"

namespace fitted {

report::Table chosen_law(bool quick) {
  using report::places;
  report::Table table{
      .name = "law", .header = {"kappa/mu", "layers", "law of bulk", "plate", "strip", "chosen law", "plate", "strip"}};
  for (const int layers : {2, 3, 4}) {
    const auto column = hmps::detail::hexagonal_column(layers, 1.0, hmps::detail::FittedWalls<double>::disorder);
    for (const double bulk : quick ? std::vector<double>{60} : std::vector<double>{5, 20, 60, 300, 2000}) {
      const auto bulk_law = hmps::thin_wall_stabiliser(std::vector<int>{0}, std::vector<double>{1}, 1, bulk, 1.0).bulk;
      const auto chosen = hmps::thin_wall_stabiliser(std::vector<int>{layers}, std::vector<double>{1}, 1, bulk, 1.0);
      const double modulus = chosen.moduli[0];
      report::Cells row{places(bulk, 0), std::to_string(layers)};
      for (const auto& split : {bulk_law, chosen.bulk})
        for (const std::string& cell : {places(split.law, 2), places(column.plate(modulus, split.law, split.mean), 3),
                                        places(column.strip(modulus, split.law, split.mean), 3)})
          row.push_back(cell);
      table.rows.push_back(row);
    }
  }
  return table;
}

}  // namespace fitted
