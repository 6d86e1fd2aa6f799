// What the figures and tables teach, in the lecture's terms.

import {html, type Html} from "../lib/html";
import {E_MAX} from "../lib/format";

export const CAPTIONS: Record<string, Html> = {
  scatter: html`Each mark is one driven square: where the robot really stood at its end minus where its odometry said it stood
    (absolute − calculated; x along the start heading, y to the left). How far the centre of a cluster lies from the
    origin, r<sub>cg</sub>, is the <b>systematic</b> error, which calibration can remove. The spread about that centre is
    the <b>non-systematic</b> error, which it cannot. The practical user cares for the worst, so the score ${E_MAX} is
    the larger of the two r<sub>cg</sub>. The heading error is not scored: a heading that is wrong on the way moves the
    end point, so the position errors already contain it.`,

  paths: html`The robot steers by its odometry, so the odometry path is the square it was asked for, while the true path
    drifts off. Millimetres in a square of metres cannot be seen: the slider multiplies the difference (shown =
    odometry + factor × (truth − odometry)); at ×1 the picture is true to scale. The line at the end joins the two end
    points: the return error.`,

  ellipses: html` <b>Ellipses</b>: where the odometry expects the true position 95 times in a hundred, if its wheels err as it
    believes, at random along the path. They are enlarged like the error. They grow with the distance, fastest across the
    direction of travel, because a heading error turns the whole path ahead, and they shrink at an absolute fix. After a
    fix the robot steers by the corrected estimate, on which the ellipses are centred; the dashed line goes on as the
    ticks alone say. Ellipses know nothing of systematic errors: of an uncalibrated robot the truth runs out of them.`,

  shares: html`The mean square of the return errors splits exactly: rms² = r<sub>cg</sub>² + spread². The <b>systematic</b>
    part comes again in every run, and calibration removes it; the <b>non-systematic</b> part does not, and no
    calibration can. On a smooth floor the systematic part dominates, on a rough one the other. With
    n runs r<sub>cg</sub>² itself still holds an n-th of spread².`,

  uncertainty: html`Predicted from the random error of each wheel's path alone (variance k² per metre; Chong &amp; Kleeman) by
    propagating the covariance through every arc. If the prediction is right, and no systematic error is left, 95 % of
    the true ends lie inside.`,

  growth: html`Difference of true and calculated pose over the distance driven, for the runs chosen in figure 2 (thick) and
    the other runs of the same kind (thin). Dotted lines mark the turns of the first run. A wrong wheelbase shows as a
    step of the heading error at each turn, unequal wheels as a steady slope along each leg; a heading error, once made,
    lets the position error grow with every metre. Nothing in odometry bounds it. It can also shrink for a while: the
    sides of a square partly cancel each other.`,

  oneWay: html`A robot that turns only 87° at each corner and drives its legs on a slight curve can still come back to its
    start. Driven the other way round, what cancelled adds up. Therefore the two-way test.`,

  oneWayWarning: html`One error can hide the other when the square is driven in one direction only: this test is unfit for
    differential drives.`,

  twoWay: html`r<sub>cg</sub> = √(x<sub>cg</sub>² + y<sub>cg</sub>²). What compensates in one direction adds up in the other,
    so the square is driven both ways and the larger r<sub>cg</sub> counts. With ${E_MAX} below about three standard
    errors, a further calibration would only fit the noise.`,

  extended: html`Cables under the inner wheel stand for an uneven floor. Each turns the robot by a fixed angle towards the
    bumped wheel. Where the robot ends depends on where the cables lie; how much it has turned does not. So the measure
    here is the heading: for each direction the mean of |e<sub>θ</sub> − mean of the plain runs|, absolute so that +1°
    and −1° do not cancel.`,

  types: html`<p><b>Type A</b> changes the total turn alike in both directions. It comes from the wheelbase (E<sub>b</sub>): a
    robot that turns 85° when told 90° turns 4 × 85° = 340° either way. <b>Type B</b> acts in opposite senses: with
    unequal wheels (E<sub>d</sub>) every leg is an arc, so one direction turns too far in all and the other too little.
    They occur together; only the sum and the difference of the two directions tell them apart.</p>`,

  recovery: html`The squares are driven anew; nothing here is predicted by algebra. On the real LabMate of the original paper
    the factor was 10 to 22. The mean wheel diameter stays as it was: no closed square can observe it.`,
};
