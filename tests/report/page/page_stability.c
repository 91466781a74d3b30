/* SPDX-License-Identifier: MIT
 *
 * The section on numerical stability: what rays come to in stiff and extreme fields, where each
 * step rule stops being trustworthy, and what is said of it while it happens. */
#include "page_stability.h"

static void introduction(page *out, const csv_table *table, const csv_table *summary) {
    page_begin(out);
    page_words(out, "Each family of fields has a parameter that is driven to where something must "
                    "give. At each value ");
    page_number(out, table, 0, "rays", "");
    page_words(
        out, " rays are traced by every step rule and judged one by one against the truth: "
             "closed forms, or sphere tracing in double through what is only grazed. A hit is "
             "*wrong* if it lies farther from the surface than tolerance and rounding explain, or "
             "behind one that it should have seen; a ray is *lost* if it misses a body that it "
             "meets deeper than rounding can hide; a *ghost* is a hit where nothing is. A ray "
             "whose budget ended is *undecided*: it says so, and how far it is free, which is an "
             "answer and no error. But a family is *trusted* only as far as at least half of the "
             "clear rays, those that meet the body beyond doubt or meet nothing, are decided. "
             "`spt_convex()` runs where its licence holds.");
    page_end(out);
    page_table(out, "All families together",
               "Rule|Families|Of them to be trusted to the end|No failing ray, but mostly "
               "undecided from some "
               "value on|Rays lost in distance bounds|Share of rays undecided");
    for (int row = 0; row < csv_rows(summary); ++row) {
        const int lost = csv_number(summary, row, "lost_on_bounds") > 0;
        page_row(out);
        page_cell_number(out, NULL, summary, row, "method", "");
        page_cell_number(out, NULL, summary, row, "families", "");
        page_cell_number(out, NULL, summary, row, "trusted", "");
        page_cell_number(out, NULL, summary, row, "half_undecided", "");
        page_cell_number(out, lost ? "bad" : "good", summary, row, "lost_on_bounds", "");
        page_cell_number(out, NULL, summary, row, "undecided_share", "%.3f");
    }
    page_table_end(out);
    page_source(out, "trust_summary");
    stability_family_table(out);
}

static void bounds(page *out, const csv_table *table) {
    static const stability_panel cost[] = {{"shell_fine", "1", stability_evaluations},
                                           {"wire_fine", "1", stability_evaluations},
                                           {"sheet", "1", stability_evaluations},
                                           {"grazing_plane_patient", "1", stability_evaluations},
                                           {"grazing_ball", "1", stability_evaluations},
                                           {"growing_ball", "1", stability_evaluations},
                                           {"sine", "1", stability_evaluations},
                                           {"twist", "1", stability_evaluations},
                                           {"dodecahedron", "1", stability_evaluations},
                                           {"krs", "1", stability_evaluations},
                                           {"moekrs", "1", stability_evaluations},
                                           {"conformal_ball", "1", stability_evaluations}};
    static const stability_panel open[] = {{"grazing_plane", "1", stability_undecided},
                                           {"grazing_plane_patient", "1", stability_undecided},
                                           {"grazing_ball", "1", stability_undecided},
                                           {"divided", "1", stability_undecided},
                                           {"divided_told", "1", stability_undecided},
                                           {"sine", "1", stability_undecided}};
    page_heading(out, "Distance bounds: what it costs");
    page_begin(out);
    page_words(
        out, "Where `|f|` never exceeds `lipschitz` times the distance, a rule is to lose nothing "
             "but evaluations (whether one lost more stands in the table above, and value by "
             "value in the folded one below). How many, and how many rays it leaves open, is what "
             "the next two figures show.");
    page_end(out);
    stability_panels(out, table, "stability_cost", cost, sizeof cost / sizeof cost[0]);
    page_words(
        out, "The 99th percentile of evaluations, over the parameter of each family. The "
             "extreme end is on the left for thickness, angle and gap, on the right for the "
             "rest. A line that lies flat is a family that the rule does not notice; one that ends "
             "at the top has spent the budget, `1000` for the plane and `128` else. ");
    page_source(out, "stability");
    page_figure_end(out);
    stability_panels(out, table, "stability_open", open, sizeof open / sizeof open[0]);
    page_words(
        out, "Rays that are still undecided when the budget ends. At a small angle to a plane "
             "evaluations grow as one over the angle, and rules that extrapolate take at best half "
             "of that, so that no budget is enough for long. A distance that is divided by a "
             "number takes that "
             "many times the steps, and its hits may lie that many tolerances short of the "
             "surface, since what is compared with the tolerance is `f`; unless `lipschitz` is "
             "divided, too. ");
    page_source(out, "stability");
    page_figure_end(out);
}

static void others(page *out, const csv_table *table) {
    static const stability_panel failing[] = {
        {"sine", "0", stability_failing},       {"twist", "0", stability_failing},
        {"planet", "0", stability_failing},     {"superquadric_naive", "0", stability_failing},
        {"jump", "0", stability_failing},       {"cells", "0", stability_failing},
        {"mandelbulb", "0", stability_failing}, {"mandelbulb_halved", "0", stability_failing},
        {"nan_cells", "0", stability_nonfinite}};
    page_heading(out, "Fields that are no distance bounds: where it fails");
    page_begin(out);
    page_words(
        out, "A field that changes faster than `lipschitz` says lets rays through, whatever the "
             "rule, the default included. The remedies are in the caller's hands: give the slope, "
             "give the size of the numbers that the callback works with, scale powers before "
             "they overflow, ask the neighbours.");
    page_end(out);
    stability_panels(out, table, "stability_failing", failing, sizeof failing / sizeof failing[0]);
    page_words(
        out, "Rays that are wrong, lost or ghosts; no rule makes a bound of a field that is none. "
             "The last plot has another measure: rays that come across NaN end and say so. Mind "
             "the vertical axes, which differ. ");
    page_source(out, "stability");
    page_figure_end(out);
    stability_trust_tables(out);
    stability_audit_table(out);
    page_begin(out);
    page_words(
        out, "The audit compares successive samples of a ray and costs no evaluation. It is a "
             "warning about the *field*, not a verdict on the ray: a ray that steps over a body at "
             "once has seen nothing steep. A callback that answers infinity, or that is wrong by "
             "its rounding, looks smooth to it.");
    page_end(out);
}

static void controls(page *out, const csv_table *table) {
    static const char *const families[] = {"sheet",        "wire_fine", "grazing_plane_patient",
                                           "growing_ball", "divided",   "scale"};
    csv_table *const loops = csv_open(out->tables, "stability_loops");
    page_heading(out, "The same rays through loops as printed");
    stability_loop_panels(out, loops, table, families, sizeof families / sizeof families[0]);
    page_words(
        out, "Controls: the loop of a textbook, which at least says when its budget ends, and "
             "the papers' listings, before the same judge. Listing 1 of Keinert et al. calls a "
             "ray a miss when its iterations end, also one that stalls short of the surface with a "
             "tolerance below what float32 resolves. Algorithm 2 of Bálint "
             "and Valasek has no margin where two spheres touch, and returns where it stands as "
             "if it had arrived. Their Algorithm 3 is not drawn: as printed it divides zero by "
             "zero on its first step, on every ray. ");
    page_source(out, "stability_loops");
    page_figure_end(out);
    csv_close(loops);
}

void page_stability(page *out) {
    csv_table *const table = csv_open(out->tables, "stability");
    csv_table *const summary = csv_open(out->tables, "trust_summary");
    page_section(out, "stability", "Numerical stability");
    introduction(out, table, summary);
    bounds(out, table);
    others(out, table);
    controls(out, table);
    page_heading(out, "Far away, and powers of two");
    stability_planes_table(out);
    stability_powers_table(out);
    csv_close(summary);
    csv_close(table);
}
