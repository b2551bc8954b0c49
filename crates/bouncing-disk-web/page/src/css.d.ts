/** The build collects the style sheets of all imports. */
declare module "*.css";
