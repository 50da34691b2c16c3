/* Steps of a belt in cells: nodes with friction, sag and rubber; stations with drums and take-up; what runs along.

   The equations, their range, error and source stand in the docstrings of the modules beside this file: march.py,
   give.py, station.py, friction_step.py and travel.py. compiled.py has the same structs in the same order.

   Forces in N, speeds in m/s, times in s, places in m, impedances and drags in N*s/m. Node i lies between the cells i
   and i + 1. Nothing here allocates memory or prints; the caller owns all arrays. */

#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef _WIN32
#define SHARED __declspec(dllexport)
#else
#define SHARED __attribute__((visibility("default")))
#endif

#ifndef SOURCE
#define SOURCE ""
#endif

/* Why a step failed: the values of FAULTS in compiled.py. */
enum { FINE, NO_TENSION, ALTERNATES, NO_MASS, TOO_STEEP, RAISED, OFF_THE_GRID, NOT_FINITE };

/* Why a march ended before its window. */
enum { GOES_ON, IS_STILL, LOST_GRIP };

#define DAMPED 1.0      /* viscosity of the spans in a front over what just keeps neighbouring lumps from ringing [1] */
#define LATE 0.3        /* weight of the end of a step in the mean tension of a span in a front [1] */
#define LATEST 0.02     /* the same where there is no front [1] */
#define ROUNDS 60       /* most rounds of Newton's rule after the first ones [1]; about ten are the most ever met */
#define TOGETHER 2      /* rounds of all nodes [1]; later ones are of those that have not settled */
#define CLOSE 1e-6      /* relative change of a tension below which Newton's rule is at its end [1]: the next is its square */
#define LEAP 1.5        /* largest change of the logarithm of a tension in one round [1] */
#define STEEPEST 100.0  /* time constants of growth in one step, where a drive pulls harder the faster it turns [1] */
#define ALTERNATIONS 12 /* most changes of what sticks and slips in one step [1]; two drums have nine states */
#define SAME 1e-12      /* relative change of a belt speed at which its centrifugal tension has settled [1] */
#define HELD (1 + 1e-9) /* friction of a belt at rest holds so much of itself [1]: its tension is a difference of large ones */
#define HALF_PI 1.57079632679489661923
#define ON_THE_GRID 1e-6 /* distance of a time from the grid, relative to the step [1], that counts as rounding */
#define SERIES 1e-3     /* time constants below which the series of the exponentials is used [1]: rounding without it */

/* Torque over the speed of a motor until the next stage: straight lines between knots up to the last of them, beyond it
   the formula of Kloss; `breakdown` 0 where there is none. */
typedef struct {
    const double *speeds, *torques;
    int64_t knots, extends;
    double breakdown, slip, stator, synchronous, until_speed, until_time;
} Stage;

/* Motors on their curve: curve.py. The reference of a converter rises along `shape` (0 straight, 1 cosine, 2 parabolas)
   or along straight lines between pairs of `points` (time, share), both relative; in a stop it falls from
   `falls_from`. */
typedef struct {
    const Stage *stages;
    const double *points;
    int64_t count, point_count, shape;
    double turns, drives, brakes, delay, off, again, reference, ramp, falls_from, fill, soft_from, soft_time;
} Curve;

/* A force [N] at the rim by time and speed, or another value by time: nothing, samples on a grid of time with ramps of
   (size, delay, rise) on top of them, motors on their curve, or a function of the caller that returns 0, the value and
   its slope. */
typedef struct {
    const double *samples;
    int64_t count;
    double step;
    const double *ramps;
    int64_t ramp_count;
    const Curve *curve;
    int (*asked)(double time, double speed, double *found);
} Law;

typedef struct Drum {
    double mass, grip, hold, share;
    int64_t one_way;
    Law force, brake;
    int64_t slip;                          /* 1 faster than the belt, -1 slower, 0 sticks */
    double speed, slid, heat, pull;
    int64_t slipped;                       /* from here on: of the step that is being made */
    double next, first, last, rate, first_given, last_given;
    const struct Drum *leader;             /* whose speed its force follows; `apart` at the other station */
    int64_t apart;
} Drum;

/* A station half a step from now follows from what it was one step ago and is now. */
typedef struct {
    double on, off, comes, leaves;
} End;

typedef struct {
    double before, after, climb_on, climb_off, friction_on, friction_off, drag_on, drag_off, line_mass;
    int64_t has_takeup;
    double takeup_tension, takeup_mass;
    Law imposed;
    int64_t is_imposed;
    double hold;
    int64_t drum_count;
    Drum *drums;
    double *tensions;                      /* before, between and behind the drums */
    double belt, behind, leaves, gives, tension, calm, lifts, creep, work, n_on, p_off;
    int64_t held, has_arrived, has_pulls, fault;
    End earlier;
} Station;

typedef struct {
    int64_t nodes;
    double step, eager, settled;
    const double *before, *after, *climb, *sags, *rate, *hang, *between, *damped, *yields, *inner, *heats, *lengths;
    double *tension, *slackness, *viscous, *late, *retarded; /* state; tension of the spans with gravity's part */
    double *tried, *passed, *change;                         /* room to work in */
    double stored, span_heat, rubber_heat;
    int64_t rounds;                                          /* of the node that took most in the last step */
} Give;

typedef struct {
    int64_t cells, tail, every, carried;
    double step, stiffness;
    const double *climb_within, *impedance, *goes;
    const double *cell_back, *cell_ahead, *node_back, *node_ahead; /* distances of places from their neighbours */
    double *tension, *speed, *way, *strain;                        /* room to work in */
} Travel;

typedef struct {
    int64_t cells, tail, k;
    double step;
    const double *before, *after, *friction, *drag, *yields, *impedance, *climb_within;
    Give *give;
    Travel *travel;
    Station *head, *low;
    double *against, *along, *speeds, *speeds_before, *doubled, *doubled_before;
    double *behind, *ways;                                  /* speeds behind the nodes; how far they went */
    double *highest, *highest_at, *lowest, *lowest_at, *longest, *longest_at;
    double *lows, *head_row, *tail_row;                     /* where the next step is noted */
    double lost, rubbed, flow, exchanged, carried;          /* powers summed over steps [W], but energy carried [J] */
    double rests_for, grips_from, presses;
    double rested;
    int64_t ended;
} March;

SHARED const char *belt_source(void) { return SOURCE; }

SHARED void belt_sizes(int64_t *sizes)
{
    const int64_t found[] = {sizeof(Stage), sizeof(Curve), sizeof(Law), sizeof(Drum), sizeof(Station), sizeof(Give),
                             sizeof(Travel), sizeof(March)};
    for (int i = 0; i < 8; i++)
        sizes[i] = found[i];
}

static double least(double a, double b) { return b < a ? b : a; }
static double most(double a, double b) { return b > a ? b : a; }
static double sign(double x) { return copysign(1.0, x); }
static double square(double x) { return x * x; }

/* -- one step of one mass ---------------------------------------------------------------------------------------- */

/* exp(-x), and by what the forcing at the start and the end of a step counts in m v/dt; x may be negative. */
SHARED void belt_exponential(double x, double *found)
{
    double grown = fabs(x) < SERIES ? 1 - x / 2 * (1 - x / 3 * (1 - x / 4)) : -expm1(-x) / x;
    double late = fabs(x) < SERIES ? 1.0 / 2 - x / 6 * (1 - x / 4 * (1 - x / 5)) : (1 - grown) / x;
    found[0] = exp(-x), found[1] = grown - late, found[2] = late;
}

static double from(double old, double mass, double against, const double *friction, const double *forcing, double step,
                   int again, int64_t *fault)
{
    if (mass <= 0) {
        double rest = fabs(forcing[1]) - friction[1];
        if (rest <= 0)
            return 0.0;
        if (against <= 0) {
            *fault = *fault ? *fault : NO_MASS;
            return 0.0;
        }
        return copysign(rest / against, forcing[1]);
    }
    if (step == 0 || (!old && friction[1] && fabs(forcing[1]) <= friction[1]))
        return old;
    double way = sign(old ? old : forcing[1]), weights[3];
    double begins = forcing[0] - way * friction[0], ends = forcing[1] - way * friction[1];
    if (!old && (friction[0] || friction[1]) && way * begins < 0) /* it breaks loose within the step */
        begins = 0.0;
    double constants = against / mass * step;
    if (constants < -STEEPEST) {
        *fault = *fault ? *fault : TOO_STEEP;
        return 0.0;
    }
    belt_exponential(constants, weights);
    double new = weights[0] * old + (weights[1] * begins + weights[2] * ends) * step / mass;
    if (new * way >= 0 || !friction[1] || again) /* only what is no number comes here twice with another sign */
        return new;
    double stops = old / (old - new); /* there friction holds it, or it turns back */
    double rubs[2] = {friction[0] + stops * (friction[1] - friction[0]), friction[1]};
    double drives[2] = {forcing[0] + stops * (forcing[1] - forcing[0]), forcing[1]};
    return from(0.0, mass, against, rubs, drives, (1 - stops) * step, 1, fault);
}

/* Speed at the end of a step of m v' + Z v + R sgn v = g: friction_step.py. */
SHARED double belt_velocity(double old, double mass, double against, const double *friction, const double *forcing,
                            double step, int64_t *fault)
{
    return from(old, mass, against, friction, forcing, step, 0, fault);
}

/* -- laws over time ----------------------------------------------------------------------------------------------- */

static double ramps_at(const Law *law, double time)
{
    double whole = 0.0;
    for (int64_t i = 0; i < law->ramp_count; i++) {
        double size = law->ramps[3 * i], delay = law->ramps[3 * i + 1], rise = law->ramps[3 * i + 2];
        if (time > delay)
            whole += size * (rise > 0 ? least((time - delay) / rise, 1.0) : 1.0);
    }
    return whole;
}

/* Torque of Kloss and its slope over the speed. */
static double kloss(const Stage *stage, double speed, double *slope)
{
    double slip = (stage->synchronous - speed) / stage->synchronous, q = stage->stator;
    int inside = fabs(slip) <= stage->slip;
    double x = inside ? slip / stage->slip : stage->slip / slip;
    double below = (1 + x) * (1 + x) - 2 * x * (1 - q), whole = 2 * stage->breakdown * (1 + q);
    double rise = (1 - x) * (1 + x) * (inside ? 1.0 : -x * x) / (below * below);
    *slope = -whole / stage->slip * rise / stage->synchronous;
    return whole * x / below;
}

static double torque_of(const Stage *stage, double speed, double *slope)
{
    int64_t last = stage->knots - 1;
    const double *speeds = stage->speeds, *torques = stage->torques;
    *slope = 0.0;
    if (last < 0 || (stage->breakdown > 0 && speed > speeds[last]))
        return kloss(stage, speed, slope);
    if (last == 0)
        return torques[0];
    if (!stage->extends && !(speeds[0] <= speed && speed <= speeds[last]))
        return torques[speed < speeds[0] ? 0 : last];
    int64_t i = 1;
    while (i < last && speed > speeds[i])
        i++;
    *slope = (torques[i] - torques[i - 1]) / (speeds[i] - speeds[i - 1]);
    return torques[i - 1] + *slope * (speed - speeds[i - 1]);
}

/* Share of the reference of a converter at a share of its rise time. */
static double reference_at(const Curve *curve, double part)
{
    const double *points = curve->points;
    if (part >= 1)
        return 1.0;
    if (curve->point_count > 1) {
        int64_t i = 1;
        while (i < curve->point_count - 1 && part > points[2 * i])
            i++;
        double before = points[2 * i - 2], low = points[2 * i - 1];
        return low + (points[2 * i + 1] - low) * (part - before) / (points[2 * i] - before);
    }
    if (curve->shape == 1)
        return sin(HALF_PI * part) * sin(HALF_PI * part);
    if (curve->shape == 2)
        return part < 0.5 ? 2 * part * part : 1 - 2 * (1 - part) * (1 - part);
    return part;
}

/* Force of motors at the rim, and its slope over the rim speed. */
static double on_curve(const Curve *curve, double time, double speed, double *slope)
{
    double since = time - (time < curve->off ? curve->delay : curve->again), turning = speed * curve->turns;
    const Stage *stage = curve->stages;
    *slope = 0.0;
    if (since < 0)
        return 0.0;
    for (int64_t i = 1; i < curve->count && !(turning < stage->until_speed && since < stage->until_time); i++)
        stage++;
    if (curve->ramp > 0) {
        double share = reference_at(curve, since / curve->ramp);
        turning += curve->reference * (1 - (curve->falls_from > 0 ? curve->falls_from * (1 - share) : share));
    }
    double torque = torque_of(stage, turning, slope), factor = torque > 0 ? curve->drives : curve->brakes;
    if (curve->fill > 0)
        factor *= -expm1(-since / curve->fill);
    if (curve->soft_time > 0) {
        double voltage = curve->soft_from + (1 - curve->soft_from) * least(since / curve->soft_time, 1.0);
        factor *= voltage * voltage;
    }
    *slope *= factor * curve->turns;
    return factor * torque;
}

/* Value of a law at a time and speed, and its slope over the speed; a fault is noted at the station. */
static double value_of(const Law *law, double time, double speed, double *slope, Station *s)
{
    *slope = 0.0;
    if (law->curve)
        return on_curve(law->curve, time, speed, slope);
    if (law->asked) {
        double found[2] = {0.0, 0.0};
        if (law->asked(time, speed, found))
            s->fault = RAISED;
        *slope = found[1];
        return found[0];
    }
    if (!law->count)
        return 0.0;
    double place = time / law->step, k = rint(place);
    if (!(k >= 0 && k < (double)law->count)) {
        s->fault = OFF_THE_GRID;
        return 0.0;
    }
    double found = law->samples[(int64_t)k];
    return law->ramp_count ? found + ramps_at(law, fabs(place - k) > ON_THE_GRID ? time : k * law->step) : found;
}

/* Force of motors on their curve, and its slope over the rim speed: curve.py. */
SHARED double belt_force(const Law *law, double time, double speed, double *slope)
{
    return on_curve(law->curve, time, speed, slope);
}

/* Forces of motors at `count` times and speeds. */
SHARED void belt_forces(const Law *law, int64_t count, const double *times, const double *speeds, double *found)
{
    double slope;
    for (int64_t i = 0; i < count; i++)
        found[i] = on_curve(law->curve, times[i], speeds[i], &slope);
}

/* Acceleration of a rigid belt by the force of all motors together. */
static double rigid_rate(const Law *laws, int64_t count, double time, double speed, double resistance, double mass)
{
    double pulls = 0.0, slope;
    for (int64_t i = 0; i < count; i++)
        pulls += on_curve(laws[i].curve, time, speed, &slope);
    return (pulls - resistance) / mass;
}

/* A rigid belt that its motors start, by Heun's rule with equal steps; it does not run back. Found are the time at which
   it has the speed `goal`, its way by then, and the time of the step at which it has `steady`. */
SHARED void belt_rigid_start(const Law *laws, int64_t count, double resistance, double mass, double goal, double steady,
                             double step, int64_t steps, double *found)
{
    double time = 0.0, speed = 0.0, way = 0.0;
    int reached = 0;
    for (int64_t k = 0; k < steps; k++) {
        double first = rigid_rate(laws, count, time, speed, resistance, mass);
        double second = rigid_rate(laws, count, time + step, most(speed + first * step, 0.0), resistance, mass);
        double new = most(speed + (first + second) / 2 * step, 0.0);
        if (!reached && new >= goal) {
            double part = (goal - speed) / (new - speed) * step;
            reached = 1, found[0] = time + part, found[1] = way + (speed + goal) / 2 * part;
        }
        way += (speed + new) / 2 * step, time += step, speed = new;
        if (reached && new >= steady)
            break;
    }
    if (!reached)
        found[0] = time, found[1] = way;
    found[2] = time;
}

/* Force of a drive at its own speed, and its slope. One that follows another has that of the leader's speed: the belt's
   as long as both go with it at one station, else the one that the leader had at the last step. */
static double force_of(const Drum *drum, double time, double speed, double *slope, Station *s)
{
    const Drum *leader = drum->leader;
    if (!leader || !(drum->apart || drum->slip || leader->slip))
        return value_of(&drum->force, time, speed, slope, s);
    double found = value_of(&drum->force, time, leader->speed, slope, s);
    *slope = 0.0;
    return found;
}

static double brake_at(Drum *drum, double time, Station *s)
{
    double slope;
    return value_of(&drum->brake, time, 0.0, &slope, s);
}

/* -- stations ----------------------------------------------------------------------------------------------------- */

/* Tension behind the drums over a step: from `first` to `last` less `yields` times the belt speed. */
typedef struct {
    double first, last, yields, friction;
} Slack;

/* One try of a step: belt speed and acceleration at its end, how friction acts (1 against forward motion, between -1
   and 1 at rest), what a backstop holds. The forces of the drives are in their drums. */
typedef struct {
    double belt, acceleration, held, holds;
} Move;

static int imposes(const Station *s) { return s->held || s->is_imposed; }

static double imposed_at(Station *s, double time)
{
    double slope;
    return s->held ? s->hold : value_of(&s->imposed, time, 0.0, &slope, s);
}

static double grip_of(const Drum *drum) { return drum->slip > 0 ? drum->grip : 1 / drum->grip; }

/* The state where nothing acts but the belt and its friction: it is in balance at any time. */
static void go_along(Station *s, double n_on, double p_off)
{
    double on = n_on + s->climb_on, off = p_off + s->climb_off, rubs = s->friction_on + s->friction_off;
    double push = off - on, before = s->before + s->drag_on, after = s->after + s->drag_off, held;
    double rest = fabs(push) - rubs;
    if (rest > 0) {
        s->belt = copysign(rest / (before + after), push);
        held = sign(push);
    } else {
        s->belt = 0.0;
        held = rubs ? push / rubs : 0.0;
    }
    s->tensions[0] = on + before * s->belt + held * s->friction_on;
    s->tensions[1] = off - after * s->belt - held * s->friction_off;
    s->leaves = s->belt + s->creep;
}

/* exp(-x) and the weights of the forcing at the start and the end of a step of x time constants: exponential_step.py. */
static void take_up_weights(double x, double *found)
{
    double grown = -expm1(-x);
    double slope = x < SERIES ? x / 2 - x * x / 6 + x * x * x / 24 - x * x * x * x / 120 : 1 - grown / x;
    found[0] = exp(-x), found[1] = grown - slope, found[2] = slope;
}

static Slack slack_of(const Station *s, double p_off, double step)
{
    double impedance = s->after + s->drag_off, arriving = p_off + s->climb_off;
    if (!s->has_takeup) {
        double before = s->has_arrived ? s->p_off : p_off;
        return (Slack){before + s->climb_off, arriving, impedance, s->friction_off};
    }
    double weight = s->takeup_mass / 4, asked = s->takeup_tension, weights[3];
    if (weight <= 0)
        return (Slack){asked, asked, 0.0, 0.0};
    double friction = s->gives * s->friction_off, apart = s->belt - s->behind;
    if (!step) {
        if (s->gives || !s->friction_off) /* whatever the belt does at once, it does to both sides of the weight */
            return (Slack){arriving, arriving - friction + impedance * apart, impedance, 0.0};
        double held = least(most(asked, arriving - s->friction_off), arriving + s->friction_off);
        return (Slack){held, held, 0.0, 0.0};
    }
    if (!s->gives && s->friction_off) { /* the weight goes with the belt alone: it adds to the drums' mass */
        double yields = weight / step;
        return (Slack){s->tension + yields * s->belt, asked + yields * s->belt, yields, 0.0};
    }
    double calm = (arriving - friction - asked) / impedance, settled = s->belt - s->calm;
    take_up_weights(impedance / weight * step, weights);
    double last = arriving - friction + impedance * (weights[0] * apart + weights[1] * settled - weights[2] * calm);
    double yields = impedance * (1 - weights[2]);
    return (Slack){s->tension + yields * s->belt, last, yields, 0.0};
}

/* Whether the belt behind a heavy take-up cannot be held by its friction, or goes with a jump of the belt. */
static int gives_way(Station *s, double p_off, double tension, double jump)
{
    double friction = s->friction_off, left = p_off + s->climb_off - tension;
    if (!(s->has_takeup && s->takeup_mass && friction) || s->gives)
        return 0;
    if (!jump && fabs(left) <= friction * HELD)
        return 0;
    s->gives = sign(jump ? jump : left);
    return 1;
}

/* Belt speed behind the take-up: Z v_r = P - T - R. */
static void settle(Station *s, double p_off, double tension)
{
    double arriving = p_off + s->climb_off, impedance = s->after + s->drag_off, friction = s->friction_off;
    double left = arriving - tension;
    int turns = s->takeup_mass > 0 && friction > 0 && s->gives * left <= 0;
    double pull = turns ? 0.0 : most(fabs(left) - friction, 0.0);
    s->behind = pull ? copysign(pull / impedance, left) : 0.0;
    s->gives = pull ? sign(left) : 0.0;
    s->tension = tension;
    s->calm = (arriving - s->gives * friction - s->takeup_tension) / impedance;
}

/* Sums over the drums from the tight side: what multiplies the belt's equation, at the start and the end of a step. */
typedef struct {
    double grip, mass, slope, early, late, rubs, grinds, backstop;
    int sticks, pulls;
} Sums;

static Sums sums_of(Station *s, double time, double old, double step)
{
    Sums all = {1.0, 0.0, 0.0, 0.0, 0.0, s->friction_on, s->friction_on, 0.0, 0, 0};
    double start = time - step, unused;
    for (int64_t j = 0; j < s->drum_count; j++) {
        Drum *drum = s->drums + j;
        double at = drum->slip ? drum->speed : old;
        drum->last = force_of(drum, time, at, &drum->rate, s);
        drum->first = step ? force_of(drum, start, at, &unused, s) : drum->last;
        all.pulls |= drum->last > 0;
        if (drum->slip) {
            all.grip *= grip_of(drum);
            continue;
        }
        all.sticks = 1;
        all.backstop = all.backstop ? all.backstop : all.grip * (double)drum->one_way;
        all.mass += all.grip * drum->mass;
        all.slope += all.grip * drum->rate;
        all.early += all.grip * (drum->first - drum->rate * at);
        all.late += all.grip * (drum->last - drum->rate * at);
        all.rubs += all.grip * brake_at(drum, step ? start : time, s);
        all.grinds += all.grip * brake_at(drum, time, s);
    }
    return all;
}

/* Try a step with the present choice of what slips; `share` of the waves' step is over when it begins. */
static Move moved(Station *s, double time, double n_on, const Slack *slack, double old, double step, double share)
{
    Sums all = sums_of(s, time, old, step);
    double lift = s->line_mass * s->lifts * s->lifts, grip = all.grip, before = s->has_arrived ? s->n_on : n_on;
    double against = s->before + s->drag_on - all.slope + grip * slack->yields;
    double wave = before + share * (n_on - before), behind = slack->first + share * (slack->last - slack->first);
    double early = all.early + grip * behind + (1 - grip) * lift - wave - s->climb_on;
    double late = all.late + grip * slack->last + (1 - grip) * lift - n_on - s->climb_on;
    double rubs[2] = {all.rubs + grip * slack->friction, all.grinds + grip * slack->friction};
    double forcing[2] = {early, late}, grinds = rubs[1];
    Move move = {0.0, 0.0, 0.0, 0.0};
    if (imposes(s) && (all.sticks || !s->drum_count)) {
        move.belt = imposed_at(s, time);
        move.acceleration = step ? (move.belt - old) / step : 0.0;
        move.held = move.belt ? sign(move.belt) : 0.0;
    } else {
        double belt = belt_velocity(old, all.mass, against, rubs, forcing, step, &s->fault);
        if (all.backstop && belt < 0)
            belt = 0.0;
        move.held = belt ? sign(belt) : grinds ? most(-1.0, least(1.0, late / grinds)) : 0.0;
        double left = late - against * belt - move.held * grinds;
        if (all.backstop && !belt && left < 0) {
            move.holds = -left / all.backstop;
            left = 0.0;
        }
        move.belt = belt;
        move.acceleration = all.mass > 0 ? left / all.mass : 0.0;
        if (all.sticks && belt > s->hold && all.pulls) {
            move.belt = s->hold, s->held = 1;
            move.acceleration = step ? (move.belt - old) / step : 0.0;
            move.held = 1.0;
        }
    }
    for (int64_t j = 0; j < s->drum_count; j++)
        if (!s->drums[j].slip)
            s->drums[j].last += s->drums[j].rate * (move.belt - old);
    return move;
}

/* Force that drives at an imposed speed share: what their drums' mass and those that slip leave of it. */
static double needed(const Station *s, double on, double off, double lift, double acceleration)
{
    double without = off, factor = 0.0;
    for (int64_t j = s->drum_count - 1; j >= 0; j--) {
        const Drum *drum = s->drums + j;
        if (drum->slip) {
            double grip = grip_of(drum);
            without = lift + grip * (without - lift);
            factor = grip * factor;
        } else {
            without -= drum->mass * acceleration;
            factor += drum->share;
        }
    }
    return factor ? (on - without) / factor : 0.0;
}

/* Tensions before, between and behind the drums. */
static void find_tensions(Station *s, double time, double n_on, const Slack *slack, const Move *move)
{
    double belt = move->belt, *tensions = s->tensions;
    int64_t count = s->drum_count, last = count > 1 ? count : 1, holding = -1;
    double on = n_on + s->climb_on + (s->before + s->drag_on) * belt + move->held * s->friction_on;
    tensions[0] = on;
    tensions[last] = slack->last - slack->yields * belt - move->held * slack->friction;
    if (count < 2)
        return;
    double lift = s->line_mass * belt * belt;
    double all = imposes(s) ? needed(s, on, tensions[last], lift, move->acceleration) : 0.0;
    for (int64_t j = count - 1; j >= 0; j--)
        if (!s->drums[j].slip && s->drums[j].one_way)
            holding = j;
    for (int64_t j = count - 1; j > 0; j--) {
        Drum *drum = s->drums + j;
        double behind = tensions[j + 1];
        if (drum->slip)
            tensions[j] = lift + grip_of(drum) * (behind - lift);
        else if (imposes(s))
            tensions[j] = behind + drum->share * all - drum->mass * move->acceleration;
        else {
            double braked = move->held * brake_at(drum, time, s);
            tensions[j] = behind + drum->last - drum->mass * move->acceleration - braked;
            tensions[j] += j == holding ? move->holds : 0.0;
        }
    }
}

/* A drum that sticks though its tensions ask for more than its grip, and the sense in which it slips; -1 for none. */
static int64_t breaks_loose(const Station *s, double belt, int64_t *sense)
{
    double lift = s->line_mass * belt * belt;
    for (int64_t j = 0; j < s->drum_count; j++) {
        const Drum *drum = s->drums + j;
        if (drum->slip || isinf(drum->grip))
            continue;
        double above = s->tensions[j] - lift, behind = s->tensions[j + 1] - lift;
        if (above > drum->grip * behind && above > behind) {
            *sense = 1;
            return j;
        }
        if (behind > drum->grip * above && behind > above) {
            *sense = -1;
            return j;
        }
    }
    return -1;
}

static int any_slips(const Station *s)
{
    for (int64_t j = 0; j < s->drum_count; j++)
        if (s->drums[j].slip)
            return 1;
    return 0;
}

/* Speeds of the drums at the end, and their drives' forces at start and end: either the belt's speed, or their own where
   they slip, m v' = F - pull - B sgn v. */
static void turn(Station *s, double time, const Move *move, double step)
{
    for (int64_t j = 0; j < s->drum_count; j++) {
        Drum *drum = s->drums + j;
        double was = drum->speed, rate;
        drum->next = move->belt, drum->first_given = drum->first, drum->last_given = drum->last;
        if (!drum->slip)
            continue;
        if (imposes(s)) {
            drum->next = imposed_at(s, time);
            continue;
        }
        double pull = s->tensions[j] - s->tensions[j + 1];
        force_of(drum, time, was, &rate, s);
        double brakes[2] = {brake_at(drum, step ? time - step : time, s), brake_at(drum, time, s)};
        double forcing[2] = {drum->first - rate * was - (s->has_pulls ? drum->pull : pull), drum->last - rate * was - pull};
        double next = belt_velocity(was, drum->mass, -rate, brakes, forcing, step, &s->fault);
        next = next < 0 && drum->one_way ? 0.0 : next;
        int held = next > drum->hold && drum->last > 0;
        drum->next = held ? drum->hold : next;
        drum->last_given = held ? pull : drum->last + rate * (drum->next - was);
    }
}

/* Tensions where drums that have come to the speed of others that stick cannot give their share of the force: these give
   all that their grip allows, at that speed. */
static void go_to_the_limit(Station *s, int64_t caught, double time, double n_on, const Slack *slack, const Move *move)
{
    for (; caught > 0; caught--) {
        int64_t sense = 0, sticking = 0, j = breaks_loose(s, move->belt, &sense);
        for (int64_t i = 0; i < s->drum_count; i++)
            sticking += !s->drums[i].slip;
        if (j < 0 || !s->drums[j].slipped || sticking < 2)
            return;
        s->drums[j].slip = sense;
        find_tensions(s, time, n_on, slack, move);
    }
}

/* Drums that came to the belt's speed inside the step: from there on they move as one. `slipped` marks them after it. */
static void catch_up(Station *s, double old, double time, double n_on, const Slack *slack, Move *move, double step)
{
    int64_t caught = 0;
    for (int64_t j = 0; j < s->drum_count; j++) {
        Drum *drum = s->drums + j;
        drum->slipped = step && drum->slipped && (double)drum->slipped * (drum->next - move->belt) <= 0;
        caught += drum->slipped;
    }
    if (!caught)
        return;
    for (int64_t j = 0; j < s->drum_count; j++) {
        Drum *drum = s->drums + j;
        if (!drum->slipped)
            continue;
        double apart = drum->speed - old, ends = drum->next - move->belt;
        double share = apart != ends ? apart / (apart - ends) : 0.0;
        share = least(most(share, 0.0), 1.0);
        double meets = drum->speed + share * (drum->next - drum->speed);
        drum->slip = 0;
        *move = moved(s, time, n_on, slack, meets, (1 - share) * step, share);
    }
    find_tensions(s, time, n_on, slack, move);
    if (imposes(s))
        go_to_the_limit(s, caught, time, n_on, slack, move);
    for (int64_t j = 0; j < s->drum_count; j++)
        if (!s->drums[j].slip)
            s->drums[j].next = move->belt;
}

/* Add up slip, its heat, and the work of drives and brakes over the step, by the trapezium rule. */
static void account(Station *s, double time, const Move *move, double old, double step)
{
    for (int64_t j = 0; j < s->drum_count; j++) {
        Drum *drum = s->drums + j;
        double apart = (fabs(drum->next - move->belt) + fabs(drum->speed - old)) / 2;
        double pull = s->tensions[j] - s->tensions[j + 1], earlier = s->has_pulls ? drum->pull : pull;
        double turned = (drum->next + drum->speed) / 2;
        drum->slid += apart * step;
        drum->heat += apart * (fabs(pull) + fabs(earlier)) / 2 * step;
        if (imposes(s)) { /* what the drum passes on and what it takes to turn it so */
            s->work += step * (pull + earlier) / 2 * turned + drum->mass * (drum->next - drum->speed) * turned;
            continue;
        }
        double brake = (brake_at(drum, time, s) + brake_at(drum, time - step, s)) / 2;
        s->work += step * ((drum->first_given + drum->last_given) / 2 * turned - brake * fabs(turned));
    }
}

/* Whether all motors that hold their speed are off. */
static int all_off(Station *s, double time, double speed)
{
    double slope;
    for (int64_t j = 0; j < s->drum_count; j++)
        if (force_of(s->drums + j, time, speed, &slope, s))
            return 0;
    return 1;
}

/* Find what sticks and slips over the step, and with it the belt's motion and the tensions; 0 where that does not end. */
static int choose(Station *s, double time, double n_on, double p_off, double old, double step, Slack *slack, Move *move)
{
    int64_t last = s->drum_count > 1 ? s->drum_count : 1;
    for (int turn = 0; turn < ALTERNATIONS; turn++) {
        int64_t sense = 0;
        *slack = slack_of(s, p_off, step);
        *move = moved(s, time, n_on, slack, old, step, 0.0);
        find_tensions(s, time, n_on, slack, move);
        int64_t loose = breaks_loose(s, move->belt, &sense);
        if (loose >= 0)
            s->drums[loose].slip = sense;
        else if (!gives_way(s, p_off, s->tensions[last], step ? 0.0 : move->belt - old)) {
            if (step || !any_slips(s) || fabs(move->belt - s->lifts) <= SAME * fabs(old))
                return 1;
            s->lifts = move->belt; /* a jump: the belt presses on its drums with the speed after it */
        }
    }
    return 0;
}

/* The state at a time, `step` after the last one, where the waves `n_on` and `p_off` arrive. */
SHARED int64_t belt_advance(Station *s, double time, double n_on, double p_off, double step)
{
    int64_t last = s->drum_count > 1 ? s->drum_count : 1;
    s->earlier = (End){s->tensions[0], s->tensions[last], s->belt, s->leaves};
    p_off -= (s->after + s->drag_off) * s->creep; /* from here on as if none left faster */
    if (!(s->drum_count || s->has_takeup || imposes(s))) {
        go_along(s, n_on, p_off);
        return FINE;
    }
    double old = s->belt;
    Slack slack;
    Move move;
    s->fault = FINE;
    for (int64_t j = 0; j < s->drum_count; j++)
        s->drums[j].slipped = s->drums[j].slip;
    s->lifts = old;
    if (s->held && all_off(s, time, old))
        s->held = 0;
    if (!choose(s, time, n_on, p_off, old, step, &slack, &move))
        return s->fault ? s->fault : ALTERNATES;
    turn(s, time, &move, step);
    catch_up(s, old, time, n_on, &slack, &move, step);
    if (step)
        account(s, time, &move, old, step);
    s->belt = move.belt, s->n_on = n_on, s->p_off = p_off, s->has_arrived = s->has_pulls = 1;
    for (int64_t j = 0; j < s->drum_count; j++) {
        s->drums[j].speed = s->drums[j].next;
        s->drums[j].pull = s->tensions[j] - s->tensions[j + 1];
    }
    if (s->has_takeup)
        settle(s, p_off, s->tensions[last]);
    s->leaves = (s->has_takeup ? s->behind : move.belt) + s->creep;
    return s->fault;
}

/* Everything at one speed at time 0. */
SHARED int64_t belt_begin(Station *s, double speed, double n_on, double p_off)
{
    s->fault = FINE;
    s->belt = imposes(s) ? imposed_at(s, 0.0) : speed;
    s->behind = s->leaves = speed, s->tension = s->calm = 0.0;
    s->gives = speed ? sign(speed) : 0.0;
    s->has_pulls = s->has_arrived = 0;
    for (int64_t j = 0; j < s->drum_count; j++)
        s->drums[j].speed = s->belt, s->drums[j].slip = 0;
    if (s->fault)
        return s->fault;
    return belt_advance(s, 0.0, n_on, p_off, 0.0);
}

/* -- what nodes give ---------------------------------------------------------------------------------------------- */

/* Bring the spans to tensions, gravity's part included. */
SHARED void belt_hang(Give *g, const double *tensions)
{
    const int64_t nodes = g->nodes;
    double *restrict tension = g->tension, *restrict slackness = g->slackness;
    double *restrict viscous = g->viscous, *restrict late = g->late;
    const double *restrict between = g->between, *restrict damped = g->damped;
    double stored = 0.0;
    for (int64_t i = 0; i < nodes; i++)
        tension[i] = tensions[i], slackness[i] = 1 / tensions[i];
    for (int64_t i = 1; i < nodes - 1; i++) {
        double front = least(fabs(tension[i + 1] - tension[i - 1]) * slackness[i] * between[i], 1.0);
        viscous[i] = damped[i] * tension[i] * sqrt(tension[i]) * front;
        late[i] = most(LATE * front, LATEST);
    }
    viscous[0] = viscous[nodes - 1] = 0.0; /* there is no front beside head and tail */
    late[0] = late[nodes - 1] = LATEST;
    for (int64_t i = 0; i < nodes; i++)
        stored += g->sags[i] * slackness[i] * (g->climb[i] * slackness[i] - 2);
    g->stored = stored; /* U - climb e = -2 k/S + climb k/S^2 */
}

/* Speed before a node, tension that it passes on, and the change of the logarithm of the tension of its span. */
typedef struct {
    double speed, passed, change;
} Try;

/* One round of Newton's rule at a node from the tension tried. A span is taken as a line: it gives a constant + `soft`
   times its tension. */
static inline Try try_at(const Give *g, int64_t i, double into, double out, double friction, double drag)
{
    double tried = g->tried[i], slackness = g->slackness[i], viscous = g->viscous[i], late = g->late[i];
    double rate = g->rate[i], after = g->after[i], inner = g->inner[i], own = -g->retarded[i] * g->eager;
    double slack = 1 / tried, squared = slack * slack;
    double drawn = slackness * slackness - squared, slope = 2 * slack * squared;
    double whole = 1 / (1 + tried * slackness), mean = 2 * (1 - late) * whole;
    double held = tried * (mean + late) + viscous * drawn - g->climb[i];
    double stiff = mean * whole + late + viscous * slope, soft = rate * slope / stiff;
    double share = 1 / (1 + after * (inner + soft)), behaves = after * share;
    double arrives = out * share - behaves * (own + rate * drawn - soft * held), q = arrives - into;
    double speed = copysign(most(fabs(q) - friction, 0.0), q) / (g->before[i] + drag + behaves);
    double passed = arrives - behaves * speed, leap = (passed - held) * slack / stiff * g->hang[i];
    return (Try){speed, passed, least(most(leap, -LEAP), LEAP)};
}

/* One round at all nodes. */
static void try_all(const Give *g, const double *into, const double *out, const double *friction, const double *drag,
                    double *restrict v, double *restrict passed, double *restrict change)
{
    for (int64_t i = 0; i < g->nodes; i++) {
        Try one = try_at(g, i, into[i], out[i], friction[i], drag[i]);
        v[i] = one.speed, passed[i] = one.passed, change[i] = one.change;
    }
}

/* Speeds of the belt before and behind every node where `into` arrives from upstream and `out` from downstream. */
SHARED int64_t belt_pass_on(Give *g, const double *into, const double *out, const double *friction, const double *drag,
                            double *v, double *behind)
{
    const int64_t nodes = g->nodes;
    double worked = 0.0, heat = 0.0, stored = g->stored;
    double *tried = g->tried, *passed = g->passed, *change = g->change;
    g->rounds = TOGETHER;
    memcpy(tried, g->tension, (size_t)nodes * sizeof *tried);
    try_all(g, into, out, friction, drag, v, passed, change);
    for (int round = 1; round < TOGETHER; round++) {
        for (int64_t i = 0; i < nodes; i++)
            tried[i] *= exp(change[i]);
        try_all(g, into, out, friction, drag, v, passed, change);
    }
    for (int64_t i = 0; i < nodes; i++) {
        int64_t round = TOGETHER;
        for (; !(fabs(change[i]) <= CLOSE); round++) { /* what is no number never settles */
            if (round == TOGETHER + ROUNDS)
                return NO_TENSION;
            tried[i] *= exp(change[i]);
            Try one = try_at(g, i, into[i], out[i], friction[i], drag[i]);
            v[i] = one.speed, passed[i] = one.passed, change[i] = one.change;
        }
        g->rounds = round > g->rounds ? round : g->rounds;
    }
    for (int64_t i = 0; i < nodes; i++) {
        tried[i] *= 1 + change[i];
        double next = 1 / tried[i], slackness = g->slackness[i];
        double gives = g->rate[i] * (slackness * slackness - next * next);
        double retards = g->inner[i] * passed[i] - g->retarded[i] * g->eager;
        worked += passed[i] * gives;
        heat += g->heats[i] * (retards * retards);
        g->retarded[i] += g->step * retards;
        behind[i] = v[i] + gives + retards;
    }
    belt_hang(g, tried);
    g->span_heat += worked * g->step - (g->stored - stored);
    g->rubber_heat += g->step * heat;
    return FINE;
}

/* Energy in spans and retarded strain [J]. */
SHARED double belt_given(const Give *g)
{
    double rubber = 0.0;
    for (int64_t i = 0; i < g->nodes; i++)
        rubber += g->yields[i] > 0 ? square(g->retarded[i]) / (2 * g->yields[i]) : 0.0;
    return g->stored + rubber;
}

/* -- what a running belt carries along ---------------------------------------------------------------------------- */

static End soon(const End *before, const End *now)
{
    return (End){1.5 * now->on - 0.5 * before->on, 1.5 * now->off - 0.5 * before->off,
                 1.5 * now->comes - 0.5 * before->comes, 1.5 * now->leaves - 0.5 * before->leaves};
}

/* Values that were `way` behind each place, none of them farther than its neighbours; `start` and `end` are the values
   at the ends, `goes` the part of the way that counts. */
static void shift(double *values, int64_t count, double start, double end, const double *way, const double *goes,
                  const double *back, const double *ahead)
{
    double before = start;
    for (int64_t i = 0; i < count; i++) {
        double here = values[i], next = i + 1 < count ? values[i + 1] : end;
        double far = goes ? goes[i] * way[i] : way[i];
        double rise = (here - before) / back[i], slope = (next - here) / ahead[i];
        far = least(most(far, -ahead[i]), back[i]);
        double bend = (slope - rise) / (back[i] + ahead[i]), origin = far > 0 ? before : next;
        double found = here - far * (rise + (back[i] - far) * bend);
        values[i] = least(most(found, least(here, origin)), most(here, origin));
        before = here;
    }
}

/* Carry all on by the way the belt goes in `every` steps; the waves of the cells change in place. */
SHARED void belt_carry(Travel *t, double *against, double *along, const End *head, const End *low, Give *g)
{
    const int64_t cells = t->cells;
    const End top = soon(head, head + 1), bottom = soon(low, low + 1), *ends[3] = {&top, &bottom, &top};
    const int64_t starts[3] = {0, t->tail, cells};
    double *tension = t->tension, *speed = t->speed, *way = t->way, *strain = t->strain;
    int rubber = g && g->settled;
    for (int64_t i = 0; i < cells; i++) {
        tension[i] = (against[i] + along[i]) / 2 + t->climb_within[i];
        speed[i] = (against[i] - along[i]) / (2 * t->impedance[i]);
        way[i] = speed[i] * ((double)t->every * t->step);
    }
    for (int64_t i = 0; i < cells - 1 && rubber; i++)
        strain[i] = g->retarded[i] / g->lengths[i] + g->settled * g->climb[i];
    for (int strand = 0; strand < 2; strand++) {
        const int64_t first = starts[strand], count = starts[strand + 1] - first;
        const End *behind = ends[strand], *before = ends[strand + 1];
        const double *back = t->cell_back + first, *ahead = t->cell_ahead + first;
        shift(tension + first, count, behind->off, before->on, way + first, 0, back, ahead);
        shift(speed + first, count, behind->leaves, before->comes, way + first, t->goes + first, back, ahead);
        if (!rubber)
            continue;
        for (int64_t i = first; i < first + count - 1; i++)
            way[i] = (way[i] + way[i + 1]) / 2; /* from here on at the nodes */
        shift(strain + first, count - 1, g->settled * behind->off, g->settled * before->on, way + first, 0,
              t->node_back + first, t->node_ahead + first);
    }
    for (int64_t i = 0; i < cells; i++) {
        double pull = tension[i] - t->climb_within[i], wave = speed[i] * t->impedance[i];
        against[i] = pull + wave;
        along[i] = pull - wave;
    }
    for (int64_t i = 0; i < cells - 1 && rubber; i++)
        g->retarded[i] = (strain[i] - g->settled * g->climb[i]) * g->lengths[i];
    t->carried++;
}

/* -- the march ---------------------------------------------------------------------------------------------------- */

/* Kinetic and elastic energy of the belt: sum (P^2 + N^2)/(4 Z) dt. */
SHARED double belt_energy(const March *m)
{
    double sum = 0.0;
    for (int64_t i = 0; i < m->cells; i++)
        sum += (square(m->against[i]) + square(m->along[i])) / (4 * m->impedance[i]);
    return sum * m->step + (m->give ? belt_given(m->give) : 0.0);
}

static int64_t end_of(const Station *s) { return s->drum_count > 1 ? s->drum_count : 1; }

/* Note a station in its row: belt speed, speed behind it, creep, tensions, speeds of the drums, their slips. */
static double *note(const Station *s, double *row)
{
    *row++ = s->belt, *row++ = s->leaves, *row++ = s->creep;
    for (int64_t j = 0; j <= end_of(s); j++)
        *row++ = s->tensions[j];
    for (int64_t j = 0; j < s->drum_count; j++)
        *row++ = s->drums[j].speed;
    for (int64_t j = 0; j < s->drum_count; j++)
        *row++ = (double)s->drums[j].slip;
    return row;
}

/* Lowest tension of cells from one to another. */
static double lowest_of(const March *m, int64_t first, int64_t end)
{
    double even = INFINITY, odd = INFINITY;
    int64_t i = first;
    for (; i + 1 < end; i += 2) {
        even = least(even, m->doubled[i] / 2 + m->climb_within[i]);
        odd = least(odd, m->doubled[i + 1] / 2 + m->climb_within[i + 1]);
    }
    return least(least(even, odd), i < end ? m->doubled[i] / 2 + m->climb_within[i] : INFINITY);
}

/* Take in twice the tensions of the cells and the speeds of the nodes as they are now. */
static void record(March *m)
{
    const int64_t cells = m->cells;
    const double k = (double)m->k, *restrict against = m->against, *restrict along = m->along;
    double *restrict doubled = m->doubled_before, *restrict highest = m->highest, *restrict highest_at = m->highest_at;
    double *restrict lowest = m->lowest, *restrict lowest_at = m->lowest_at;
    m->doubled_before = m->doubled, m->doubled = doubled;
    for (int64_t i = 0; i < cells; i++) {
        double now = against[i] + along[i];
        doubled[i] = now;
        highest_at[i] = now > highest[i] ? k : highest_at[i];
        highest[i] = now > highest[i] ? now : highest[i];
        lowest_at[i] = now < lowest[i] ? k : lowest_at[i];
        lowest[i] = now < lowest[i] ? now : lowest[i];
    }
    *m->lows++ = lowest_of(m, 0, m->tail);
    *m->lows++ = lowest_of(m, m->tail, cells);
    m->head_row = note(m->head, m->head_row);
    m->tail_row = note(m->low, m->tail_row);
}

/* How far nodes went, and what friction and drag took there. */
static void record_nodes(March *m)
{
    const int64_t nodes = m->cells - 1;
    const double k = (double)m->k, step = m->step, *restrict speeds = m->speeds;
    double *restrict ways = m->ways, *restrict longest = m->longest, *restrict longest_at = m->longest_at;
    double rubbed = 0.0, dragged = 0.0;
    for (int64_t i = 0; i < nodes; i++) {
        ways[i] += speeds[i] * step;
        longest_at[i] = ways[i] > longest[i] ? k : longest_at[i];
        longest[i] = ways[i] > longest[i] ? ways[i] : longest[i];
    }
    for (int64_t i = 0; i < nodes; i++) {
        rubbed += fabs(speeds[i]) * m->friction[i];
        dragged += speeds[i] * speeds[i] * m->drag[i];
    }
    m->lost += rubbed + dragged;
}

/* Power that friction and drag lumped at a station take. */
static double rubbed_at(const Station *s)
{
    double on = fabs(s->belt), off = fabs(s->leaves);
    return (s->friction_on + s->drag_on * on) * on + (s->friction_off + s->drag_off * off) * off;
}

/* Power that a station gives to the belt, by the waves that leave and arrive. */
static double flow_at(const Station *s, double n_on, double p_off)
{
    return (n_on + s->before * s->belt) * s->belt - (p_off - s->after * s->leaves) * s->leaves;
}

static double creep_of(const Station *s, double stiffness)
{
    return s->belt * (s->tensions[end_of(s)] - s->tensions[0]) / stiffness;
}

/* Speeds of straight elastic nodes with friction that sticks or slides. */
static void slide(const March *m, const double *restrict into, const double *restrict out, double *restrict v)
{
    const double *restrict friction = m->friction, *restrict yields = m->yields;
    for (int64_t i = 0; i < m->cells - 1; i++) {
        double q = out[i] - into[i];
        v[i] = (q - most(least(q, friction[i]), -friction[i])) * yields[i];
    }
}

/* Send the waves on by a cell, with what nodes and stations make of them. */
static void send_on(March *m, double n_on, double p_off, double n_tail, double p_tail, const double *behind)
{
    const int64_t cells = m->cells, at = m->tail - 1;
    const double *restrict v = m->speeds, *restrict before = m->before, *restrict after = m->after;
    double *restrict into = m->along, *restrict out = m->against + 1;
    const Station *head = m->head, *low = m->low;
    for (int64_t i = 0; i < cells - 1; i++) {
        into[i] += before[i] * v[i];
        out[i] -= after[i] * behind[i];
    }
    into[at] = n_tail + before[at] * low->belt;
    out[at] = p_tail - after[at] * low->leaves;
    m->along[cells - 1] = n_on + 2 * head->before * head->belt;
    m->against[0] = p_off - 2 * head->after * head->leaves;
    double *swapped = m->against;
    m->against = m->along, m->along = swapped;
}

static void carry_on(March *m)
{
    const Station *head = m->head, *low = m->low;
    double before = belt_energy(m);
    End top[2] = {head->earlier, {head->tensions[0], head->tensions[end_of(head)], head->belt, head->leaves}};
    End bottom[2] = {low->earlier, {low->tensions[0], low->tensions[end_of(low)], low->belt, low->leaves}};
    belt_carry(m->travel, m->against, m->along, top, bottom, m->give);
    m->carried += belt_energy(m) - before;
}

static int64_t step_on(March *m)
{
    const int64_t last = m->cells - 1, at = m->tail - 1;
    const double time = (double)++m->k * m->step;
    const double n_on = m->along[last], p_off = m->against[0], n_tail = m->along[at], p_tail = m->against[at + 1];
    double *v = m->speeds_before;
    Station *head = m->head, *low = m->low;
    int64_t fault = FINE;
    m->speeds_before = m->speeds, m->speeds = v;
    if (m->give)
        fault = belt_pass_on(m->give, m->along, m->against + 1, m->friction, m->drag, v, m->behind);
    else
        slide(m, m->along, m->against + 1, v);
    if (m->travel) {
        head->creep = creep_of(head, m->travel->stiffness);
        low->creep = creep_of(low, m->travel->stiffness);
    }
    fault = fault ? fault : belt_advance(low, time, n_tail, p_tail, m->step);
    fault = fault ? fault : belt_advance(head, time, n_on, p_off, m->step);
    if (fault)
        return fault;
    if (!m->give) /* of a belt that gives, the row at the end has what its own node would do there */
        v[at] = low->belt;
    double given = flow_at(head, n_on, p_off) + flow_at(low, n_tail, p_tail);
    m->rubbed += rubbed_at(head) + rubbed_at(low);
    m->flow += given, m->exchanged += fabs(given);
    send_on(m, n_on, p_off, n_tail, p_tail, m->give ? m->behind : v);
    if (m->travel && m->k % m->travel->every == 0)
        carry_on(m);
    record(m);
    record_nodes(m);
    return FINE;
}

/* Whether a drum turns at another speed than the belt; one that gives all its grip at the belt's speed does not. */
static int slides(const Station *s)
{
    for (int64_t j = 0; j < s->drum_count; j++)
        if (s->drums[j].slip && s->drums[j].speed != s->belt)
            return 1;
    return 0;
}

/* Whether the march ends here, by what the head does. */
static int64_t ending(March *m)
{
    const Station *head = m->head;
    const double time = (double)m->k * m->step;
    for (int64_t j = 0; j <= end_of(head); j++)
        if (head->tensions[j] < m->presses && any_slips(head))
            return LOST_GRIP;
    if (m->rested < 0 && head->belt <= 0)
        m->rested = time;
    if (m->rested >= 0 && time >= m->rested + m->rests_for)
        return IS_STILL;
    return time >= m->grips_from && !slides(head) ? IS_STILL : GOES_ON;
}

/* Note the belt as it begins. */
SHARED void belt_start(March *m) { record(m); }

/* So many steps, or until the march ends; what went wrong, or 0. */
SHARED int64_t belt_march(March *m, int64_t steps)
{
    for (int64_t i = 0; i < steps && !m->ended; i++) {
        int64_t fault = step_on(m);
        if (fault)
            return fault;
        m->ended = ending(m);
    }
    double sum = 0.0;
    for (int64_t i = 0; i < m->cells; i++)
        sum += 0 * m->against[i] + 0 * m->along[i];
    return sum == 0 ? FINE : NOT_FINITE;
}
