/** A function that runs `draw` once before the next picture, however often it is called. */
export function oncePerPicture(draw) {
  let isAsked = false;
  return () => {
    if (isAsked) return;
    isAsked = true;
    requestAnimationFrame(() => {
      isAsked = false;
      draw();
    });
  };
}
