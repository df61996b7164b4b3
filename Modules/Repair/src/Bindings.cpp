#include "Bindings.h"

#include <vector>

namespace sinew::repair {

std::span<const Binding> allBindings() {
  static const std::vector<Binding> all = [] {
    std::vector<Binding> list;
    for (const auto part : {solidBindings(), shapeBindings(), measureBindings(), tissueBindings()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  return all;
}

}  // namespace sinew::repair
