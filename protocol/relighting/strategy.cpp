#include "protocol/relighting/strategy.h"

namespace relume::relighting {

std::string_view name_from(Method method) {
    return kMethodNames.name(method);
}
std::string_view name_from(Priority priority) {
    return kPriorityNames.name(priority);
}

}  // namespace relume::relighting
