#include "energy/star_kernels_set.hpp"
