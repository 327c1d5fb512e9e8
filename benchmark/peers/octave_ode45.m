% GNU Octave's ode45 with its events, as in typical MATLAB programs of the field.
% Methods: ode45, from one event to the next over the rest of the record; ode45/sample: with steps no longer than a
% sample interval. The setting is the relative tolerance. Physics: theory.md, sections 1 to 4.
1;
warning ("off", "all");  % ode45 warns at every terminal event
% A program that is killed must not leave its variables, all records among them, in the current folder
sigterm_dumps_octave_core (false);
sighup_dumps_octave_core (false);
crash_dumps_octave_core (false);

function [i, t, side] = next_start (wall, a, dt, i, t)
  last = numel (a);
  side = 0;
  if (i >= last)
    return;
  endif
  trigger = tan (wall.capacity);
  here = a(i) + (a(i+1) - a(i)) * (t / dt);
  opens = @(x) -x > trigger | (wall.two_sided & x > trigger);
  if (opens (here))
    side = -sign (here);
    return;
  endif
  k = find (opens (a(i+1:end)), 1);
  if (isempty (k))
    return;
  endif
  if (k > 1)
    i += k - 1;
    t = 0;
    here = a(i);
  endif
  side = -sign (a(i+1));
  t += (dt - t) * ((-side * trigger - here) / (a(i+1) - here));
endfunction

function ends = stays (wall, a, dt, i, t, side, speed, peak)
  % Whether the wall is at rest after an impact, or its chain of bounces provably ends at rest
  ends = true;
  last = numel (a);
  e = wall.restitution;
  push = a(i);
  if (i < last)
    push += (a(i+1) - a(i)) * (t / dt);
  endif
  inward = wall.moment + side * wall.lever * push;
  if (speed == 0 || (inward > 0 && 2 * speed / inward <= 2.2e-13 * dt))
    return;
  endif
  from = moments (wall, side * push);
  least = from;
  growth = 1;
  elapsed = -t;
  while (true)
    push = 0;
    if (i < last)
      push = side * a(i+1);
    endif
    to = moments (wall, push);
    least = min (least, to);
    growth *= max ([1, to ./ from]);
    rise = 0.5 * speed^2 * 1.03 * growth / min (least);
    if (any (least <= 0) || rise > min (wall.height, peak) || growth > 10)
      ends = false;
      return;
    endif
    duration = 2 * speed * sqrt (1.03 * growth) * (1 / least(1) + e / least(2)) / (1 - e^2);
    elapsed += dt;
    if (duration <= elapsed || i >= last)
      return;
    endif
    from = to;
    i += 1;
  endwhile
endfunction

function m = moments (wall, push)
  m = (1 - wall.slack) * wall.moment + wall.lever * push - wall.slack * wall.lever * abs (push);
  m = [m, m - wall.two_sided * 2 * wall.lever * push];
endfunction

function peak = peak_after (wall, q, v)
  rest = wall.p2 * cos (wall.capacity);
  energy = 0.5 * v^2 + wall.p2 * cos (wall.capacity - q);
  if (v <= 0)
    energy = rest + wall.restitution^2 * (energy - rest);
  endif
  peak = wall.capacity;
  if (energy < wall.p2)
    peak -= acos (energy / wall.p2);
  endif
endfunction

function rate = right_side (t, y, wall, a, dt, side)
  i = min (floor (t / dt) + 1, numel (a) - 1);
  x = wall.capacity - y(1);
  push = side * (a(i) + (a(i+1) - a(i)) * (t / dt - i + 1));
  rate = [y(2); -wall.p2 * (sin(x) + push * cos(x))];
endfunction

function [gap, terminal, direction] = events (t, y, wall)
  gap = [y(1); y(1) - wall.capacity; y(2)];
  terminal = [1; 1; 0];
  direction = [-1; 1; -1];
endfunction

function [edp, collapsed, impacts] = simulate (wall, a, dt, rtol, by_sample)
  i = 1;
  t = peak = impacts = 0;
  collapsed = false;
  finish = (numel (a) - 1) * dt;
  options = odeset ("RelTol", rtol, "AbsTol", 0.01 * rtol * wall.capacity * [1; sqrt(wall.p2)], ...
                    "Events", @(t, y) events (t, y, wall), "InitialStep", dt);
  if (by_sample)
    options = odeset (options, "MaxStep", dt);
  endif
  while (true)
    [i, t, side] = next_start (wall, a, dt, i, t);
    if (side == 0)
      edp = peak / wall.capacity;
      return;
    endif
    first = i;
    start = t;
    y = [0; 0];
    tiny = 0;  # bounces in a row
    while (true)
      now = (i - 1) * dt + t;
      [times, states, te, ye, ie] = ode45 (@(t, y) right_side (t, y, wall, a, dt, side), [now, finish], y, options);
      peak = max ([peak; states(:, 1)]);
      if (! isempty (ie) && any (ie == 3))
        peak = max (peak, max (ye(ie == 3, 1)));
      endif
      y = states(end, :).';
      if (peak >= wall.capacity)
        edp = 1;
        collapsed = true;
        return;
      endif
      if (times(end) >= finish)
        peak = max (peak, peak_after (wall, y(1), y(2)));
        edp = peak / wall.capacity;
        collapsed = peak >= wall.capacity;
        return;
      endif
      impacts += 1;
      i = min (floor (times(end) / dt) + 1, numel (a) - 1);
      t = times(end) - (i - 1) * dt;
      y = [0; wall.restitution * max(0, -y(2))];
      if (wall.two_sided)
        side = -side;
      endif
      tiny = (tiny + 1) * (0.5 * y(2)^2 < 1e-12 * wall.capacity * wall.moment);
      if (tiny > 1000 || stays (wall, a, dt, i, t, side, y(2), peak))
        break;
      endif
    endwhile
    % A start exactly at the threshold that rounding undoes at once is not repeated.
    if (i == first && t - start <= 2.2e-13 * dt)
      i += 1;
      t = 0;
    endif
  endwhile
endfunction

words = argv ();
file = fopen (words{1}, "r");
numbers = fread (file, Inf, "double");
fclose (file);
rtol = str2double (words{3});
repeats = str2double (words{4});
every = str2double (words{5});
wall = struct ("capacity", numbers(1), "p2", numbers(2), "restitution", numbers(4), "two_sided", numbers(5) != 0);
wall.moment = wall.p2 * sin (wall.capacity);
wall.lever = wall.p2 * cos (wall.capacity);
wall.height = 1e-3 * wall.capacity;
while (true)
  wall.slack = abs (sin (wall.capacity - wall.height) / sin (wall.capacity) - 1) ...
               + abs (cos (wall.capacity - wall.height) / cos (wall.capacity) - 1);
  if (wall.slack <= 4e-3)
    break;
  endif
  wall.height *= 0.5;
endwhile
records = numbers(6);
sizes = reshape (numbers(8:7+2*records), 2, records);
ends = 7 + 2 * records + cumsum (sizes(2, :));
pairs = reshape (numbers(ends(end)+1:end), 2, []);

printf ("version GNU Octave %s\n", OCTAVE_VERSION);
for repeat = 1:repeats
  outcomes = zeros (0, 3);
  tic;
  for k = 1:every:numbers(7)
    r = pairs(1, k) + 1;
    a = pairs(2, k) * numbers(ends(r)-sizes(2, r)+1:ends(r)) / numbers(3);
    [edp, collapsed, impacts] = simulate (wall, a, sizes(1, r), rtol, strcmp (words{2}, "ode45/sample"));
    outcomes(end+1, :) = [edp, collapsed, impacts];
  endfor
  printf ("seconds %.6f\n", toc);
endfor
printf ("%.17g %d %d\n", outcomes.');
