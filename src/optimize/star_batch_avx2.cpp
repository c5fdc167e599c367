#include "optimize/star_batch_set.hpp"
