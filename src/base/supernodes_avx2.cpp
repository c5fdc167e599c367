#include "base/supernodes_set.hpp"
