#include "tets/optimize/kernels_set.hpp"
