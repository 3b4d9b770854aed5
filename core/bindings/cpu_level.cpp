// Compiled without wide instructions: it runs before the processor's level is known.
#include "bindings/cpu_level.h"

#include <nanobind/nanobind.h>

NB_MODULE(_cpu_level, m) {
  m.def("cpu_level", &snapspace::cpu_level,
        "Highest x86-64 level (1 to 4) that this processor supports; 0 on other processors.");
}
