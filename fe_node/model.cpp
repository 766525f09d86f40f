#include "fe_node/model.h"
