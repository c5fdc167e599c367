#include "step_parts_set.hpp"
