// Cards shared by *PART_INERTIA and *CONSTRAINED_NODAL_RIGID_BODY_INERTIA.
#pragma once

#include "fe_node/deck/card_io.h"
#include "fe_node/deck/part_records.h"

namespace crosswalk::fe {

void inertia_cards(CardIo& io, PartInertia& inertia);

}  // namespace crosswalk::fe
