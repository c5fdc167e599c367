#include "tets/energy/parts_set.hpp"
