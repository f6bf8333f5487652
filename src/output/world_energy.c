/* SPDX-License-Identifier: MIT */
/* world_energy.c - the ledger of a world: the sum of those of its bodies. What each counts as work of the others is taken out of
   `external`, and in its place stand what is stored in contact between them and what dashpots and friction there took. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static void peri__add_energy(peri_energy *sum, const peri_energy *e, const peri_body *b) {
    const double unit = b->desc.ledger ? b->model->energy : 0.0;
    sum->kinetic += e->kinetic;
    sum->elastic += e->elastic;
    sum->contact += e->contact;
    sum->external += e->external - b->now.ledger.others * unit;
    sum->obstacle += e->obstacle;
    sum->damping += e->damping + b->now.ledger.rubbed * unit;
    sum->fracture += e->fracture;
    sum->initial += e->initial;
}

PERI_API int32_t peri_world_get_energy(peri_world *w, peri_energy *energy) {
    int begins = 1, counts = 1;
    if (!w) return PERI_ERROR_ARGUMENT;
    if (!energy) return peri__world_fail(w, PERI_ERROR_ARGUMENT, "energy", -1, 0.0);
    memset(energy, 0, sizeof *energy);
    for (int64_t k = 0; k < w->seats; ++k) {
        peri_body *b = peri__nth_body(w, k);
        if (b->running > PERI__IN_FRAME) return peri__world_fail(w, PERI_ERROR_ORDER, "peri_unlock", -1, 0.0);
        begins = begins && b->now.steps == 0;
        counts = counts && b->desc.ledger;
    }
    if (w->seats == 0) return PERI_OK;
    if (!peri__ready_world(w)) return peri__world_fail(w, PERI_ERROR_MEMORY, "contact", -1, 0.0);
    const double contact = peri__press_world(w);
    for (int64_t k = 0; k < w->seats; ++k) {
        peri_energy e;
        const int32_t status = peri__world_heed(w, peri__nth_body(w, k), peri_get_energy(peri__nth_body(w, k), &e));
        if (status < 0) return status;
        peri__add_energy(energy, &e, peri__nth_body(w, k));
    }
    energy->contact += contact * w->energy;
    if (!counts) return PERI_OK;
    const double moved = w->running ? w->put_in : begins ? contact : w->put_in + contact - w->stored;
    energy->initial += moved * w->energy;
    energy->error = peri__imbalance(energy);
    return PERI_OK;
}
