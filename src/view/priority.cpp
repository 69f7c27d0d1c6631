#include "view/priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace knotlight {

void set_niceness(int niceness) {
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
}

}  // namespace knotlight
