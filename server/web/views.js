// The parts of a system's page. Adding one is its module and a line here.
import { AccuracyView } from "./view_accuracy.js";
import { BifurcationsView } from "./view_bifurcations.js";
import { EquationsView } from "./view_equations.js";
import { EquilibriaView } from "./view_equilibria.js";
import { GaitView } from "./view_gait.js";
import { ModesView } from "./view_modes.js";
import { MotionView } from "./view_motion.js";
import { PracticeView } from "./view_practice.js";
import { SweepView } from "./view_sweep.js";
import { TurningView } from "./view_turning.js";

/**
 * One part: `show` fills its node whenever something changed; `leave` gives the drawing back.
 * @typedef {{ node: HTMLElement, show: (signal: AbortSignal) => Promise<void>, tick?: (t: number) => void, motionCame?: () => void, motionFailed?: (error: unknown) => void, leave?: () => void }} View
 */

/** @type {{ name: string, title: string, needs: string, make: (page: import("./system.js").SystemPage) => View }[]} */
export const views = [
  { name: "motion", title: "Motion", needs: "simulate", make: (page) => new MotionView(page) },
  { name: "equations", title: "Equations", needs: "equations", make: (page) => new EquationsView(page) },
  { name: "modes", title: "Modes", needs: "modes", make: (page) => new ModesView(page) },
  { name: "turning", title: "Turning points", needs: "turning_points", make: (page) => new TurningView(page) },
  { name: "equilibria", title: "Equilibria", needs: "equilibria", make: (page) => new EquilibriaView(page) },
  { name: "bifurcations", title: "Bifurcations", needs: "bifurcations", make: (page) => new BifurcationsView(page) },
  { name: "gait", title: "Gait", needs: "gait", make: (page) => new GaitView(page) },
  { name: "accuracy", title: "Accuracy", needs: "accuracy", make: (page) => new AccuracyView(page) },
  { name: "sweep", title: "Sweep", needs: "energy", make: (page) => new SweepView(page) },
  { name: "practice", title: "Practice", needs: "equations", make: (page) => new PracticeView(page) },
];
